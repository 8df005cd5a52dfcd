#include "castor/tools/cli/recorded_run.hpp"

#include "castor/actors/system/recording.hpp"
#include "castor/base/duration.hpp"
#include "castor/base/input_file.hpp"
#include "castor/tools/cli/output.hpp"

#include <nlohmann/json.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int format_version = 1;

void include_time(RecordingContents& into, UnixTime first, UnixTime last) {
  into.first = into.first.count() == 0 ? first : std::min(into.first, first);
  into.last = std::max(into.last, last);
}

} // namespace

bool RecordingFolder::is_one(const fs::path& folder) {
  std::error_code error;
  return fs::exists(RecordingFolder{folder}.facts_file(), error);
}

RunFacts RecordingFolder::facts() const {
  std::string text;
  try {
    text = read_input_file(facts_file());
  } catch (const InputFileError& e) {
    throw std::runtime_error("cannot read " + facts_file().string() + ": " + e.what());
  }
  try {
    auto x = Json::parse(text);
    if (auto format = x.at("format").get<int>(); format != format_version)
      throw std::runtime_error(fmt::format("{} is a recording of format {}; this castor reads {}",
                                           folder_.string(), format, format_version));
    RunFacts result;
    result.file = x.at("file").get<std::string>();
    result.variables = x.at("variables").get<std::map<std::string, std::string>>();
    result.version = x.at("castor").get<std::string>();
    result.begin = UnixTime{x.at("begin").get<std::int64_t>()};
    if (x.contains("end"))
      result.end = UnixTime{x["end"].get<std::int64_t>()};
    result.until_quiet = x.value("until_quiet", "");
    return result;
  } catch (const Json::exception& e) {
    throw std::runtime_error(facts_file().string() + " is damaged: " + e.what());
  }
}

void RecordingFolder::write(const RunFacts& x) const {
  Json json{{"format", format_version},
            {"castor", x.version},
            {"file", x.file},
            {"variables", x.variables},
            {"begin", x.begin.count()}};
  if (x.end)
    json["end"] = x.end->count();
  if (!x.until_quiet.empty())
    json["until_quiet"] = x.until_quiet;
  auto out = create(facts_file());
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

Json to_json(const PushLogSummary& x) {
  return {{"provider", x.provider},     {"pushes", x.pushes},
          {"pulls", x.pulls},           {"first", in_seconds(x.first)},
          {"last", in_seconds(x.last)}, {"bytes", x.bytes},
          {"dropped", x.dropped},       {"lost", x.lost}};
}

std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension) {
  std::error_code error;
  std::vector<fs::path> result;
  for (auto& x : fs::directory_iterator{folder, error})
    if (x.path().extension() == extension)
      result.push_back(x.path());
  if (error)
    throw std::runtime_error("cannot read the folder " + folder.string() + ": " + error.message());
  std::sort(result.begin(), result.end());
  return result;
}

std::uint64_t RecordingContents::changes_of(const std::string& component) const {
  std::uint64_t result = 0;
  for (auto& [subarchitecture, writers] : changes_by)
    if (auto i = writers.find(component); i != writers.end())
      result += i->second;
  return result;
}

RecordingContents contents_of(const std::vector<fs::path>& journals,
                              const std::vector<fs::path>& pushes) {
  RecordingContents result;
  for (auto& file : journals) {
    auto summary = JournalReader{file}.summary();
    result.entries += JournalReader{file}.replay().size();
    result.changes += summary.changes;
    result.bytes += summary.bytes;
    if (summary.changes > 0)
      include_time(result, summary.first, summary.last);
    auto& writers = result.changes_by[summary.subarchitecture];
    // As a replay makes them: who began with an entry wrote it, too.
    Recording recording{{{file}, {}}};
    while (auto step = recording.next()) {
      auto& write = std::get<RecordedWrite>(*step);
      writers[write.source] += write.changes.size();
      include_time(result, write.time, write.time);
    }
  }
  for (auto& file : pushes) {
    auto& summary = result.pushes.emplace_back(PushLogReader{file}.summary());
    result.bytes += summary.bytes;
    if (summary.pushes + summary.pulls > 0)
      include_time(result, summary.first, summary.last);
  }
  return result;
}

std::string in_words(const RecordingContents& x) {
  std::map<std::string, std::uint64_t> writers;
  for (auto& [subarchitecture, changes] : x.changes_by)
    for (auto& [writer, count] : changes)
      writers[writer] += count;
  std::vector<std::string> parts;
  for (auto& [writer, count] : writers)
    parts.push_back(fmt::format("{} by {}", count, writer));
  auto result =
    parts.empty() ? "no changes" : "changes: " + fmt::format("{}", fmt::join(parts, ", "));
  for (auto& push : x.pushes)
    result += fmt::format("; {} pushes of {} and {} answers to pulls", push.pushes, push.provider,
                          push.pulls);
  return result;
}

} // namespace castor::cli
