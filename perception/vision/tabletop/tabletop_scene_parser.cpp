#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "castor/base/suggestion.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_check.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_names.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_statement.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

/// Enough for a table, and few enough to render and to check all pairs.
constexpr std::size_t max_actors = 100;

class SceneReader {
public:
  explicit SceneReader(std::string file_name) : file_name_(std::move(file_name)) {
    // nop
  }

  TabletopSceneText read(std::string_view text) {
    for (const auto& line : text_lines(text)) {
      try {
        read_line(line);
      } catch (const StatementError& error) {
        report(Severity::error, line, error.what(), error.remedy());
        // What a later line refers to may be what this line failed to say.
        objects_are_missing_ = true;
      }
    }
    scene_.camera = look_at(camera_.eye, camera_.target, camera_.fov_degrees, image_.width,
                            image_.height, table_frame);
    play();
    check();
    sort_by_line(problems_);
    return {std::move(scene_), std::move(problems_)};
  }

private:
  struct Event {
    SceneTime time;
    TextLine line;
    SceneEvent what;
  };

  void report(Severity severity, const TextLine& line, std::string message, std::string remedy) {
    problems_.push_back(finding(severity, file_name_, line, std::move(message), std::move(remedy)));
  }

  void read_line(const TextLine& line) {
    StatementWords words(line.words);
    const std::string keyword = words.peek();
    if (is_scene_setting(keyword)) {
      if (const auto [first, is_new] = setting_lines_.emplace(keyword, line.number); !is_new)
        throw StatementError("\"" + keyword + "\" is given twice",
                             "Remove this line or line " + std::to_string(first->second) + ".");
      words.next("a setting");
      read_setting(keyword, words);
    } else if (keyword == "after") {
      const SceneTime time = read_time(words);
      events_.push_back({time, line, read_event(words)});
    } else {
      // Before everything that happens, even if it happens at once.
      events_.push_back({SceneTime{-1}, line, AddEvent{read_object(words)}});
    }
    words.expect_end();
  }

  void read_setting(const std::string& keyword, StatementWords& words) {
    auto& setting = scene_.setting;
    if (keyword == "table")
      setting.table = read_table(words);
    else if (keyword == "camera")
      camera_ = read_camera_place(words);
    else if (keyword == "image")
      image_ = read_image_size(words);
    else if (keyword == "light")
      setting.light = read_light(words);
    else if (keyword == "noise")
      setting.noise = read_noise(words);
    else
      setting.seed = read_seed(words);
  }

  void play() {
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    for (const auto& event : events_) {
      try {
        const SceneTime time = std::max(event.time, SceneTime{0});
        if (const auto* add = std::get_if<AddEvent>(&event.what)) {
          play_add(*add, time, event.line);
        } else if (const auto* move = std::get_if<MoveEvent>(&event.what)) {
          if (const auto actor = find(move->reference, time))
            scene_.actors[*actor].moves.push_back({time, move->duration, move->x, move->y});
        } else if (const auto* removal = std::get_if<RemoveEvent>(&event.what)) {
          if (const auto actor = find(removal->reference, time))
            scene_.actors[*actor].disappears = time;
        }
      } catch (const StatementError& error) {
        report(Severity::error, event.line, error.what(), error.remedy());
      }
    }
  }

  void play_add(const AddEvent& add, SceneTime time, const TextLine& line) {
    if (scene_.actors.size() == max_actors)
      throw StatementError("there are more than " + std::to_string(max_actors) + " objects",
                           "Leave some out.");
    for (std::size_t i = 0; i < scene_.actors.size(); ++i)
      if (!add.object.name.empty() && scene_.actors[i].object.name == add.object.name &&
          scene_.actors[i].is_there(time))
        throw StatementError("there already is an object named \"" + add.object.name +
                               "\", in line " + std::to_string(actor_lines_[i].number),
                             "Give this one another name.");
    scene_.actors.push_back({add.object, time, std::nullopt, {}});
    actor_lines_.push_back(line);
  }

  /// The index of the actor that is meant; nothing if the line that brings it is known to be wrong.
  std::optional<std::size_t> find(const ObjectReference& reference, SceneTime time) const {
    std::vector<std::size_t> found;
    std::vector<std::string> present;
    for (std::size_t i = 0; i < scene_.actors.size(); ++i) {
      const auto& actor = scene_.actors[i];
      if (!actor.is_there(time))
        continue;
      present.push_back(short_description(actor.object));
      const bool is_meant = reference.shape
                              ? actor.object.shape == *reference.shape &&
                                  actor.object.colour == colour_named(reference.colour_name)
                              : actor.object.name == reference.name;
      if (is_meant)
        found.push_back(i);
    }
    if (found.size() == 1)
      return found[0];
    if (found.empty() && objects_are_missing_)
      return std::nullopt;
    const std::string wanted = reference.text();
    if (found.empty()) {
      const auto guess = did_you_mean(wanted, {present.begin(), present.end()});
      throw StatementError("there is no \"" + wanted + "\" on the table at that time",
                           !guess.empty()    ? guess
                           : present.empty() ? "The table is empty then; add an object before."
                                             : "There are then: " + joined(present) + ".");
    }
    throw StatementError("there are " + std::to_string(found.size()) + " objects that are \"" +
                           wanted + "\" at that time",
                         "Give the one that you mean a name, for example " + wanted +
                           " at 0 0 name=first, and write that name here.");
  }

  static std::string short_description(const TabletopObject& object) {
    return object.name.empty() ? object.colour_name + " " + std::string(to_string(object.shape))
                               : object.name;
  }

  void check() {
    for (const auto& remark : check_scene(scene_))
      report(remark.is_error ? Severity::error : Severity::warning, actor_lines_[remark.actor],
             remark.message, remark.remedy);
  }

  std::string file_name_;
  TabletopScene scene_;
  CameraPlace camera_;
  ImageSize image_;
  std::map<std::string, int> setting_lines_;
  std::vector<Event> events_;
  /// The line that brought each of the scene's actors.
  std::vector<TextLine> actor_lines_;
  std::vector<Diagnostic> problems_;
  bool objects_are_missing_ = false;
};

} // namespace

TabletopSceneText parse_tabletop_scene(std::string_view text, const std::string& file_name) {
  return SceneReader(file_name).read(text);
}

TabletopSceneText load_tabletop_scene(const std::filesystem::path& path) {
  return load_parsed(path, parse_tabletop_scene);
}

} // namespace castor::vision
