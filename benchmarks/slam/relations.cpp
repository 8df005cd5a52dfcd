#include "castor/benchmarks/slam/relations.hpp"

#include "castor/base/input_file.hpp"
#include "castor/mapping/logs/gzip.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/timed_poses.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace castor::slam_benchmark {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 28;

Diagnostic finding(const std::string& file, std::size_t number, std::string_view line,
                   const std::string& message, const std::string& remedy) {
  Diagnostic result;
  result.where = SourceLocation{file, number};
  result.line = std::string{line.substr(0, 80)};
  result.message = message;
  result.remedy = remedy;
  return result;
}

// The numbers of a line; nothing if there are more, fewer, or other words.
template <std::size_t Count>
std::optional<std::array<double, Count>> numbers_of(std::string_view line) {
  std::array<double, Count> result{};
  for (auto& x : result) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), x);
    if (error != std::errc{} || !std::isfinite(x))
      return {};
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
  if (line.find_first_not_of(" \t\r") != std::string_view::npos)
    return {};
  return result;
}

bool is_before(const TimedPose& x, std::int64_t time) {
  return x.time < time;
}

} // namespace

RelationsResult parse_relations(std::string_view text, const std::string& file) {
  RelationsResult result;
  std::vector<Relation> relations;
  for (std::size_t number = 1; !text.empty(); ++number) {
    auto end = text.find('\n');
    auto line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    auto first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#')
      continue;
    auto numbers = numbers_of<8>(line);
    if (!numbers) {
      result.diagnostics.push_back(finding(file, number, line, "this is no relation",
                                           "write: time1 time2 x y z roll pitch yaw"));
      continue;
    }
    auto& x = *numbers;
    relations.push_back({std::llround(x[0] * 1e6), std::llround(x[1] * 1e6), {x[2], x[3], x[7]}});
  }
  if (relations.empty() && result.diagnostics.empty())
    result.diagnostics.push_back(
      finding(file, 0, {}, "there are no relations", "write: time1 time2 x y z roll pitch yaw"));
  if (!has_errors(result.diagnostics))
    result.relations = std::move(relations);
  return result;
}

RelationsResult read_relations(const std::filesystem::path& file) {
  try {
    auto bytes = read_input_file(file, most_bytes);
    if (mapping::is_gzip(bytes))
      bytes = mapping::gunzip(bytes, most_bytes);
    return parse_relations(bytes, file.string());
  } catch (const InputFileError& e) {
    return {{}, {finding(file.string(), 0, {}, e.what(), "give the path of a file of relations")}};
  } catch (const mapping::GzipError& e) {
    return {{}, {finding(file.string(), 0, {}, e.what(), "fetch or compress the file again")}};
  }
}

PathResult parse_path(std::string_view text, const std::string& file) {
  constexpr const char* remedy = "write: time x y heading, in order of time";
  PathResult result;
  std::vector<TimedPose> path;
  for (std::size_t number = 1; !text.empty(); ++number) {
    auto end = text.find('\n');
    auto line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    auto first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#')
      continue;
    auto x = numbers_of<4>(line);
    auto time = x ? std::llround((*x)[0] * 1e6) : 0;
    if (!x)
      result.diagnostics.push_back(finding(file, number, line, "this is no pose", remedy));
    else if (!path.empty() && time < path.back().time)
      result.diagnostics.push_back(finding(file, number, line, "time runs backward", remedy));
    else
      path.push_back({time, {(*x)[1], (*x)[2], (*x)[3]}});
  }
  if (path.empty() && result.diagnostics.empty())
    result.diagnostics.push_back(finding(file, 0, {}, "there are no poses", remedy));
  if (!has_errors(result.diagnostics))
    result.path = std::move(path);
  return result;
}

PathResult read_path(const std::filesystem::path& file) {
  try {
    return parse_path(read_input_file(file, most_bytes), file.string());
  } catch (const InputFileError& e) {
    return {{}, {finding(file.string(), 0, {}, e.what(), "give the path of a file of poses")}};
  }
}

Statistics statistics_of(const std::vector<double>& numbers) {
  Statistics result;
  if (numbers.empty())
    return result;
  auto n = static_cast<double>(numbers.size());
  for (auto x : numbers) {
    result.mean += x / n;
    result.most = std::max(result.most, x);
  }
  for (auto x : numbers)
    result.deviation += (x - result.mean) * (x - result.mean);
  result.deviation = numbers.size() > 1 ? std::sqrt(result.deviation / (n - 1)) : 0;
  return result;
}

std::optional<mapping::Pose2> pose_at(const std::vector<TimedPose>& path, std::int64_t time,
                                      std::int64_t most_gap) {
  auto after = std::lower_bound(path.begin(), path.end(), time, is_before);
  // Times in files of relations have fewer digits than those in logs.
  constexpr std::int64_t rounding = 100;
  auto later = after != path.end() ? after->time - time : rounding + 1;
  auto earlier = after != path.begin() ? time - std::prev(after)->time : rounding + 1;
  if (std::min(later, earlier) <= rounding)
    return later < earlier ? after->pose : std::prev(after)->pose;
  if (after == path.begin() || after == path.end())
    return {};
  auto before = std::prev(after);
  if (std::min(time - before->time, after->time - time) > most_gap)
    return {};
  return mapping::pose_between(path, time);
}

std::int64_t clock_offset(const std::vector<TimedPose>& path,
                          const std::vector<Relation>& relations) {
  std::vector<std::int64_t> offsets;
  auto add = [&](std::int64_t time) {
    auto after = std::lower_bound(path.begin(), path.end(), time, is_before);
    if (after == path.end() || after == path.begin())
      return;
    auto later = after->time - time;
    auto earlier = std::prev(after)->time - time;
    offsets.push_back(later < -earlier ? later : earlier);
  };
  for (const auto& x : relations) {
    add(x.from);
    add(x.to);
  }
  if (offsets.empty())
    return 0;
  auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
  std::nth_element(offsets.begin(), middle, offsets.end());
  // More than rounding: most times are those of no pose.
  constexpr std::int64_t most = 1000;
  return std::abs(*middle) <= most ? *middle : 0;
}

RelationErrors relation_errors(const std::vector<TimedPose>& path,
                               const std::vector<Relation>& relations, std::int64_t most_gap) {
  RelationErrors result;
  std::vector<double> translation;
  std::vector<double> rotation;
  auto offset = clock_offset(path, relations);
  for (const auto& x : relations) {
    auto from = pose_at(path, x.from + offset, most_gap);
    auto to = pose_at(path, x.to + offset, most_gap);
    if (!from || !to) {
      ++result.without_pose;
      continue;
    }
    auto off = mapping::between(x.pose, mapping::between(*from, *to));
    translation.push_back(std::hypot(off.x, off.y));
    rotation.push_back(std::abs(off.heading));
  }
  auto squares = [](std::vector<double> numbers) {
    for (auto& x : numbers)
      x *= x;
    return numbers;
  };
  result.relations = translation.size();
  result.translation = statistics_of(translation);
  result.rotation = statistics_of(rotation);
  result.squared_translation = statistics_of(squares(translation));
  result.squared_rotation = statistics_of(squares(rotation));
  return result;
}

TrajectoryErrors trajectory_errors(const std::vector<TimedPose>& path,
                                   const std::vector<TimedPose>& truth, std::int64_t most_gap) {
  std::vector<std::pair<mapping::Pose2, mapping::Pose2>> pairs;
  for (const auto& x : path)
    if (auto there = pose_at(truth, x.time, most_gap))
      pairs.emplace_back(x.pose, *there);
  TrajectoryErrors result;
  result.poses = pairs.size();
  if (pairs.empty())
    return result;
  const auto n = static_cast<double>(pairs.size());
  const auto alignment = mapping::best_alignment(pairs);
  std::vector<double> errors;
  for (const auto& [x, y] : pairs) {
    auto aligned = compose(alignment, x);
    errors.push_back(distance(aligned, y));
    result.root_mean_square += errors.back() * errors.back() / n;
    result.heading_mean += std::abs(mapping::normalised(aligned.heading - y.heading)) / n;
  }
  result.root_mean_square = std::sqrt(result.root_mean_square);
  std::sort(errors.begin(), errors.end());
  result.median = errors[errors.size() / 2];
  result.most = errors.back();
  return result;
}

} // namespace castor::slam_benchmark
