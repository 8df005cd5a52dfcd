#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Parsers of the statements of the scene language, for tabletop_scene_parser.hpp.
namespace castor::vision {

/// Error in a statement, with its remedy.
class StatementError : public std::runtime_error {
public:
  StatementError(const std::string& message, std::string remedy)
    : std::runtime_error(message), remedy_(std::move(remedy)) {
    // nop
  }

  const std::string& remedy() const { return remedy_; }

private:
  std::string remedy_;
};

/// The words of a line, taken one by one.
class StatementWords {
public:
  explicit StatementWords(std::span<const std::string> words) : words_(words) {
    // nop
  }

  bool at_end() const { return words_.empty(); }

  /// The next word, empty at the end.
  std::string peek() const { return at_end() ? std::string() : words_.front(); }

  /// Takes the next word.
  /// \throws StatementError at the end, with the message that `what` is missing.
  std::string next(const std::string& what);

  /// Takes the next word if it is `word`; returns whether it was.
  bool accept(const std::string& word);

  /// Takes a number, or a length in metres.
  /// \throws StatementError if there is none, or if it is not in [low, high].
  double number(const std::string& what, double low, double high);
  double length(const std::string& what, double low, double high);

  /// Takes a time, such as 2s.
  SceneTime time(const std::string& what);

  /// \throws StatementError if there is a word left.
  void expect_end() const;

private:
  std::span<const std::string> words_;
};

/// Defaults as in nominal_camera(); here they are what is rendered.
struct CameraPlace {
  Point3 eye{0, -0.75, 0.70};
  Point3 target;
  double fov_degrees = 50;
};

struct ImageSize {
  int width = 640;
  int height = 480;
};

/// A reference to an object: by colour and shape, or by name.
struct ObjectReference {
  std::string name;
  std::string colour_name;
  std::optional<TabletopShape> shape;

  /// As it was written.
  std::string text() const;
};

struct AddEvent {
  TabletopObject object;
};

struct MoveEvent {
  ObjectReference reference;
  double x = 0;
  double y = 0;
  SceneTime duration{0};
};

struct RemoveEvent {
  ObjectReference reference;
};

using SceneEvent = std::variant<AddEvent, MoveEvent, RemoveEvent>;

/// Whether `word` begins a line of the setting: table, camera, image, light, noise, seed.
bool is_scene_setting(const std::string& word);

/// Parse the rest of a setting's line, after its first word.
/// \throws StatementError
TableLook read_table(StatementWords& words);
CameraPlace read_camera_place(StatementWords& words);
ImageSize read_image_size(StatementWords& words);
Point3 read_light(StatementWords& words);
double read_noise(StatementWords& words);
std::uint64_t read_seed(StatementWords& words);

/// COLOUR SHAPE at X Y [size ...] [turned DEGREES] [name=NAME]
/// \throws StatementError
TabletopObject read_object(StatementWords& words);

/// The "after TIME" of an event.
/// \throws StatementError
SceneTime read_time(StatementWords& words);

/// What follows: add OBJECT, move REFERENCE to X Y [over TIME], remove REFERENCE.
/// \throws StatementError
SceneEvent read_event(StatementWords& words);

/// The number with at most six digits, for messages.
std::string readable(double number);

/// The names, separated by commas.
std::string joined(std::span<const std::string> names);

} // namespace castor::vision
