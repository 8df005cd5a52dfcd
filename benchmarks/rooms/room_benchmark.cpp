// How well rooms are found in floor plans whose true rooms are known; see room_scores.hpp for the
// measure, and floor_plan.hpp for the plans.
//
//     room_benchmark DIR [OPTIONS]
//
// Prints recall/precision of each plan, empty and furnished, and their means.

#include "castor/benchmarks/rooms/floor_plan.hpp"
#include "castor/benchmarks/rooms/other_methods.hpp"
#include "castor/benchmarks/rooms/room_scores.hpp"
#include "castor/mapping/rooms/room_segmentation.hpp"
#include "castor/mapping/rooms/rooms_picture.hpp"

#include <CLI/CLI.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace castor;
using namespace castor::mapping;

using Segment = std::function<std::vector<std::int32_t>(const CellMap&, const RoomOptions&)>;

const std::map<std::string, Segment> methods{
  {"rooms", [](auto& map, auto& options) { return segment_rooms(map, options).labels; }},
  {"erosion", [](auto& map, auto& options) { return rooms_by_erosion(map, options); }},
  {"threshold", [](auto& map, auto& options) { return rooms_by_threshold(map, options); }},
  {"watershed", [](auto& map, auto& options) { return rooms_by_watershed(map, options); }}};

struct Task {
  std::filesystem::path folder;
  std::filesystem::path pictures;
  std::string method = "rooms";
  bool leave_one_out = false;
  RoomOptions options;
};

/// A variant of a plan that there is a file of.
struct Plan {
  std::string name;
  std::size_t variant = 0;
  CellMap map;
  std::vector<std::int32_t> truth;
};

std::vector<Plan> read_plans(const std::filesystem::path& folder) {
  std::vector<Plan> result;
  for (const auto& name : floor_plans(folder)) {
    const auto truth = read_true_rooms(folder, name);
    for (std::size_t i = 0; i < floor_plan_variants().size(); ++i) {
      const auto file = folder / (name + floor_plan_variants()[i].suffix + ".png");
      if (std::filesystem::exists(file))
        result.push_back({name, i, read_floor_plan(file), truth});
    }
  }
  if (result.empty())
    throw std::runtime_error(folder.string() + ": there are no files NAME_gt_segmentation.png and "
                                               "NAME.png; give the folder that has them");
  return result;
}

RoomScores scores_of(const Plan& plan, const Segment& segment, const RoomOptions& options) {
  return room_scores(plan.truth, segment(plan.map, options));
}

struct Mean {
  double recall = 0;
  double precision = 0;
  std::size_t count = 0;

  void add(const RoomScores& x) {
    recall += x.recall;
    precision += x.precision;
    ++count;
  }

  std::string text() const {
    auto n = static_cast<double>(count);
    return count == 0 ? "-" : fmt::format("{:.3f}/{:.3f}", recall / n, precision / n);
  }
};

/// Writes the picture of a plan's rooms.
void draw(const Plan& plan, const Task& task) {
  std::filesystem::create_directories(task.pictures);
  const auto png = picture_of(plan.map, segment_rooms(plan.map, task.options));
  const auto file =
    task.pictures / (plan.name + floor_plan_variants()[plan.variant].suffix + ".png");
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  if (!out.flush())
    throw std::runtime_error("cannot write " + file.string());
}

void print_row(const std::string& name, const std::vector<std::string>& columns) {
  fmt::print("{:<24}", name);
  for (const auto& x : columns)
    fmt::print(" {:<22}", x);
  fmt::print("\n");
}

std::vector<std::string> titles() {
  std::vector<std::string> result;
  for (const auto& x : floor_plan_variants())
    result.push_back(x.name);
  return result;
}

/// Recall/precision (rooms found of how many) of each plan, and means.
void print_scores(const std::vector<Plan>& plans, const Task& task) {
  const auto& segment = methods.at(task.method);
  print_row("plan", titles());
  std::vector<Mean> means(floor_plan_variants().size());
  double longest = 0;
  for (auto plan = plans.begin(); plan != plans.end();) {
    std::vector<std::string> columns(means.size(), "-");
    const auto& name = plan->name;
    for (; plan != plans.end() && plan->name == name; ++plan) {
      const auto begin = std::chrono::steady_clock::now();
      const auto scores = scores_of(*plan, segment, task.options);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      longest = std::max(longest, taken.count());
      means[plan->variant].add(scores);
      columns[plan->variant] = fmt::format("{:.3f}/{:.3f} ({} of {})", scores.recall,
                                           scores.precision, scores.found_rooms, scores.true_rooms);
      if (!task.pictures.empty())
        draw(*plan, task);
    }
    print_row(name, columns);
  }
  std::vector<std::string> columns;
  for (const auto& x : means)
    columns.push_back(x.text());
  print_row("mean", columns);
  fmt::print("longest {:.0f} ms\n", 1000 * longest);
}

/// For each plan the options that suit the other plans best, and what they give on it.
void print_leave_one_out(const std::vector<Plan>& plans, const Task& task) {
  const auto& segment = methods.at(task.method);
  std::vector<RoomOptions> choices;
  for (double ratio : {0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85})
    for (double furniture : {0.5, 0.75, 1.0, 1.25, 1.5}) {
      choices.push_back(task.options);
      choices.back().neck_ratio = ratio;
      choices.back().largest_furniture = furniture;
    }
  std::vector<std::vector<RoomScores>> scores;
  for (const auto& options : choices) {
    scores.emplace_back();
    for (const auto& plan : plans)
      scores.back().push_back(scores_of(plan, segment, options));
  }
  print_row("plan", titles());
  std::vector<Mean> means(floor_plan_variants().size());
  for (const auto& name : floor_plans(task.folder)) {
    auto value_on_others = [&](const std::vector<RoomScores>& x) {
      double sum = 0;
      for (std::size_t i = 0; i < plans.size(); ++i)
        if (plans[i].name != name)
          sum += x[i].recall + x[i].precision;
      return sum;
    };
    const auto best = std::ranges::max_element(scores, {}, value_on_others);
    const auto& options = choices[static_cast<std::size_t>(best - scores.begin())];
    std::vector<std::string> columns(means.size(), "-");
    for (std::size_t i = 0; i < plans.size(); ++i)
      if (plans[i].name == name) {
        means[plans[i].variant].add((*best)[i]);
        columns[plans[i].variant] =
          fmt::format("{:.3f}/{:.3f}", (*best)[i].recall, (*best)[i].precision);
      }
    columns.push_back(
      fmt::format("neck {}, furniture {} m", options.neck_ratio, options.largest_furniture));
    print_row(name, columns);
  }
  std::vector<std::string> columns;
  for (const auto& x : means)
    columns.push_back(x.text());
  print_row("mean", columns);
}

} // namespace

int main(int count, char** values) {
  Task task;
  std::vector<std::string> names;
  for (const auto& x : methods)
    names.push_back(x.first);
  CLI::App app("recall/precision of room segmentation on floor plans");
  app.add_option("DIR", task.folder, "folder with NAME.png and NAME_gt_segmentation.png")
    ->required();
  app.add_option("--pictures", task.pictures, "folder for pictures of the rooms");
  app.add_option("--method", task.method, "method")
    ->check(CLI::IsMember(names))
    ->capture_default_str();
  app.add_flag("--leave-one-out", task.leave_one_out,
               "choose options on the other plans for each plan");
  app.add_option("--neck", task.options.neck_ratio, "RoomOptions::neck_ratio")
    ->capture_default_str();
  app.add_option("--furniture", task.options.largest_furniture, "RoomOptions::largest_furniture")
    ->capture_default_str();
  app.footer("Examples: room_benchmark plans --pictures out\n"
             "          room_benchmark plans --leave-one-out");
  CLI11_PARSE(app, count, values);
  try {
    const auto plans = read_plans(task.folder);
    if (task.leave_one_out)
      print_leave_one_out(plans, task);
    else
      print_scores(plans, task);
  } catch (const std::exception& e) {
    fmt::print(stderr, "room_benchmark: {}\n", e.what());
    return 1;
  }
  return 0;
}
