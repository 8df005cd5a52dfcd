#include "castor/mapping/building/building_file.hpp"

#include "castor/mapping/building/building_check.hpp"
#include "castor/mapping/building/building_statement.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace castor::mapping {

namespace {

// Enough for a floor of a large building, and few enough to check all pairs.
constexpr std::size_t most_walls = 500;
constexpr std::size_t most_things = 1000;

class BuildingReader {
public:
  explicit BuildingReader(std::string file_name) : file_name_(std::move(file_name)) {
    // nop
  }

  BuildingText read(std::string_view text) {
    for (const auto& line : text_lines(text)) {
      lines_.emplace(line.number, line);
      try {
        read_line(line);
      } catch (const StatementError& error) {
        report(Severity::error, line, error.what(), error.remedy());
        const auto& keyword = line.words.front();
        walls_may_be_missing_ |=
          keyword == "wall" || std::ranges::count(building_keywords(), keyword) == 0;
      }
    }
    name_what_has_no_name();
    if (!keywords_.contains("start"))
      report(Severity::error, {}, "there is no \"start\" line",
             "Say where the robot begins, for example: start 2.5 2.5 heading 90");
    // Without a wall, rooms would be open and doors in no wall.
    if (!walls_may_be_missing_)
      check();
    sort_by_line(problems_);
    return {std::move(building_), std::move(problems_)};
  }

private:
  void report(Severity severity, const TextLine& line, std::string message, std::string remedy) {
    problems_.push_back(finding(severity, file_name_, line, std::move(message), std::move(remedy)));
  }

  void read_line(const TextLine& line) {
    StatementWords words(line.words);
    const std::string keyword = words.next("a statement");
    if (keyword == "building" || keyword == "height" || keyword == "start")
      if (auto [first, is_new] = keywords_.emplace(keyword, line.number); !is_new)
        throw StatementError("\"" + keyword + "\" is given twice",
                             "Remove this line or line " + std::to_string(first->second) + ".");
    if (keyword == "building")
      building_.name = words.name("the building's name");
    else if (keyword == "height")
      building_.height = words.length("the height", 0.5, 20);
    else if (keyword == "thickness")
      thickness_ = words.length("the thickness", 0.01, 2);
    else if (keyword == "wall")
      add_walls(read_walls(words, thickness_), line.number);
    else if (keyword == "door")
      add(building_.doors, read_door(words), line.number, "doors");
    else if (keyword == "room")
      add(building_.rooms, read_room(words), line.number, "rooms");
    else if (keyword == "furniture")
      add(building_.furniture, read_furniture(words), line.number, "pieces of furniture");
    else if (keyword == "object")
      add(building_.objects, read_building_object(words), line.number, "objects");
    else if (keyword == "person")
      add(building_.people, read_walker(words), line.number, "people");
    else if (keyword == "start") {
      building_.start = read_start(words);
      building_.start_line = line.number;
    } else
      throw StatementError("\"" + keyword + "\" is not the beginning of a statement",
                           remedy_for(keyword, building_keywords(), "statements"));
    words.expect_end();
  }

  void add_walls(std::vector<Wall> walls, int line) {
    if (building_.walls.size() + walls.size() > most_walls)
      throw StatementError("there are more than " + std::to_string(most_walls) + " walls",
                           "Leave some out, or divide the building into several files.");
    for (auto& wall : walls) {
      wall.line = line;
      building_.walls.push_back(wall);
    }
  }

  template <class Thing>
  void add(std::vector<Thing>& things, Thing thing, int line, const std::string& what) {
    if (things.size() == most_things)
      throw StatementError("there are more than " + std::to_string(most_things) + " " + what,
                           "Leave some out.");
    thing.line = line;
    things.push_back(std::move(thing));
  }

  template <class Thing>
  void name_things(std::vector<Thing>& things, std::set<std::string>& taken) {
    for (auto& thing : things) {
      if (thing.name.empty() && counts_.at(thing.kind) == 1 && taken.insert(thing.kind).second)
        thing.name = thing.kind;
      auto& named = named_[thing.kind];
      while (thing.name.empty()) {
        auto name = thing.kind + "-" + std::to_string(++named);
        if (taken.insert(name).second)
          thing.name = std::move(name);
      }
    }
  }

  /// After its kind, with a number if there are several: desk-1, desk-2.
  void name_what_has_no_name() {
    std::set<std::string> taken;
    auto collect = [&](const auto& things) {
      for (const auto& x : things)
        taken.insert(x.name);
    };
    collect(building_.doors);
    collect(building_.rooms);
    collect(building_.furniture);
    collect(building_.objects);
    collect(building_.people);
    for (const auto& x : building_.furniture)
      ++counts_[x.kind];
    for (const auto& x : building_.objects)
      ++counts_[x.kind];
    name_things(building_.furniture, taken);
    name_things(building_.objects, taken);
  }

  void check() {
    for (const auto& x : complete_building(building_)) {
      // Of a start that the file does not say, nothing.
      if (building_.start_line == 0 && x.line == 0)
        continue;
      const auto line = lines_.find(x.line);
      report(x.is_error ? Severity::error : Severity::warning,
             line == lines_.end() ? TextLine{} : line->second, x.message, x.remedy);
    }
  }

  std::string file_name_;
  Building building_;
  double thickness_ = 0.1;
  std::map<int, TextLine> lines_;
  /// Lines of the statements that there may be one of.
  std::map<std::string, int> keywords_;
  /// How many pieces of furniture and objects there are of a kind, and how many have got a number.
  std::map<std::string, int> counts_;
  std::map<std::string, int> named_;
  std::vector<Diagnostic> problems_;
  bool walls_may_be_missing_ = false;
};

} // namespace

BuildingText parse_building(std::string_view text, const std::string& file_name) {
  return BuildingReader(file_name).read(text);
}

BuildingText load_building(const std::filesystem::path& path) {
  return load_parsed(path, parse_building);
}

} // namespace castor::mapping
