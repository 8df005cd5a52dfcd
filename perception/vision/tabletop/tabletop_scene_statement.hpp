#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "castor/base/statement_words.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Parsers of the statements of the scene language, for tabletop_scene_parser.hpp.
namespace castor::vision {

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

} // namespace castor::vision
