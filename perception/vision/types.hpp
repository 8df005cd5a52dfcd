#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types of the vision working memory: what vision knows, and all that other subarchitectures
/// may know of vision.
namespace castor::vision {

/// A point in an image; pixels, x to the right, y down, (0, 0) the centre of the upper left pixel.
struct Point2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point2&, const Point2&) = default;
};

/// A point on or above the table; metres, z up, z = 0 the table's surface.
struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Point3&, const Point3&) = default;
};

/// A unit quaternion.
struct Rotation {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Rotation&, const Rotation&) = default;
};

/// Maps body coordinates to table coordinates: p_table = rotation * p_body + position.
struct Pose {
  Point3 position;
  Rotation rotation;

  friend bool operator==(const Pose&, const Pose&) = default;
};

/// Pixels in rows from the top; `bytes` has width * height * channels of them, 3 channels are B, G,
/// R.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 3;
  std::vector<std::uint8_t> bytes;

  friend bool operator==(const Image&, const Image&) = default;
};

/// An upright rectangle in an image, pixels.
struct ImageBox {
  Point2 center;
  double width = 0;
  double height = 0;

  friend bool operator==(const ImageBox&, const ImageBox&) = default;
};

/// A box on the table, metres.
struct ObjectBox {
  Point3 centroid;
  Point3 size;

  friend bool operator==(const ObjectBox&, const ObjectBox&) = default;
};

/// One hypothesis about a property, such as a colour: its name and a confidence in [0, 1].
struct Hypothesis {
  std::string value = "unknown";
  double confidence = 0;

  friend bool operator==(const Hypothesis&, const Hypothesis&) = default;
};

/// A pinhole camera with the usual lens distortion (radial k1..k3, tangential t1, t2). Its body
/// coordinates are x to the right, y down, z forward; fx, fy, cx, cy are pixels.
struct Camera {
  std::int32_t number = 0;
  Pose pose;
  std::int32_t width = 0;
  std::int32_t height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  double k1 = 0;
  double k2 = 0;
  double k3 = 0;
  double t1 = 0;
  double t2 = 0;

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// What a camera component delivers to those who pull from it or have it pushed; never an entry.
struct CameraFrame {
  Image image;
  Camera camera;
  /// When it was taken, microseconds since the system began.
  std::int64_t time = 0;
  /// How many frames came before it.
  std::uint64_t index = 0;
};

/// One entry per camera, only ever overwritten: is the scene moving, has it come to rest changed,
/// has that change been seen to?
struct SceneChanged {
  bool changing = false;
  bool changed = false;
  bool processed = false;
  std::int32_t camera = 0;
};

/// What the feature extractor adds to a region: evidence, not decisions.
struct RegionFeatures {
  /// Colour names, the likeliest first.
  std::vector<Hypothesis> colours;
  /// Shape names, the likeliest first.
  std::vector<Hypothesis> shapes;
  /// The measurement that learned colours are judged by: L*, a* and b* of the paint.
  std::vector<double> colour_evidence;
  /// The measurements that the shapes were judged by; the order is the shape classifier's.
  std::vector<double> shape_evidence;
  /// Where the region meets the table and how large it is there; all zero without a calibration.
  ObjectBox extent;
};

/// One entry per camera that has pictures kept of it, only ever overwritten: what the scene looked
/// like when it was last seen to, small and with names on the things in it, for people.
struct ScenePicture {
  Image image;
  std::int32_t camera = 0;
  /// When the image was taken, microseconds since the system began.
  std::int64_t time = 0;
};

/// A region of interest: a part of an image in which something stands out from the background.
struct ROI {
  ImageBox box;
  /// The pixels in `box` (3 channels), and which of them belong to the region (1 channel, 0 or
  /// 255).
  Image region;
  Image mask;
  /// The outline in image coordinates.
  std::vector<Point2> contour;
  std::int32_t camera = 0;
  /// When the image was taken, microseconds since the system began.
  std::int64_t time = 0;
  /// The SceneObject that this is a view of; empty while unknown.
  std::string object_id;
  /// False until the feature extractor has seen to the region.
  bool has_features = false;
  RegionFeatures features;
};

/// A thing on the table, the vision system's best hypothesis of it.
struct SceneObject {
  std::int64_t time = 0;
  ObjectBox box;
  Pose pose;
  Hypothesis label;
  Hypothesis colour;
  Hypothesis shape;
  Hypothesis size;
  std::vector<std::string> roi_ids;
  /// The only component that may delete the object and its regions.
  std::string managing_process;
};

/// Added beside every overwrite of a SceneObject: what it changed.
struct SceneObjectUpdate {
  std::string object_id;
  bool position = false;
  bool shape = false;
  bool size = false;
  bool colour = false;
  bool label = false;
};

/// Something that a thing is said to be: a word for its "colour" or its "shape".
struct Attribute {
  std::string kind;
  Hypothesis value;
};

/// Added by whoever knows, or has been told, what a thing is called; deleted by the learner that
/// has seen to it.
struct LearnInstruction {
  /// A tutor has said so; otherwise the robot has concluded it.
  bool tutor_initiated = true;
  /// The SceneObject or the ROI that this is about.
  std::string target_id;
  std::vector<Attribute> attributes;
};

/// A word and what it was learned from.
struct LearnedWord {
  std::string kind;
  std::string word;
  /// How many there were; one of which the tutor was not sure counts less.
  double examples = 0;
  /// Of their evidence.
  std::vector<double> mean;
  /// The sum of their squared distances from the mean.
  double scatter = 0;

  friend bool operator==(const LearnedWord&, const LearnedWord&) = default;
};

/// One entry: all that the learner knows, for those who name things.
struct LearnedWords {
  std::vector<LearnedWord> words;
};

CASTOR_REFLECT(Point2, x, y)
CASTOR_REFLECT(Point3, x, y, z)
CASTOR_REFLECT(Rotation, w, x, y, z)
CASTOR_REFLECT(Pose, position, rotation)
CASTOR_REFLECT(Image, width, height, channels, bytes)
CASTOR_REFLECT(ImageBox, center, width, height)
CASTOR_REFLECT(ObjectBox, centroid, size)
CASTOR_REFLECT(Hypothesis, value, confidence)
CASTOR_REFLECT(Camera, number, pose, width, height, fx, fy, cx, cy, k1, k2, k3, t1, t2)
CASTOR_REFLECT(CameraFrame, image, camera, time, index)
CASTOR_REFLECT(SceneChanged, changing, changed, processed, camera)
CASTOR_REFLECT(ScenePicture, image, camera, time)
CASTOR_REFLECT(RegionFeatures, colours, shapes, colour_evidence, shape_evidence, extent)
CASTOR_REFLECT(ROI, box, region, mask, contour, camera, time, object_id, has_features, features)
CASTOR_REFLECT(SceneObject, time, box, pose, label, colour, shape, size, roi_ids, managing_process)
CASTOR_REFLECT(SceneObjectUpdate, object_id, position, shape, size, colour, label)
CASTOR_REFLECT(Attribute, kind, value)
CASTOR_REFLECT(LearnInstruction, tutor_initiated, target_id, attributes)
CASTOR_REFLECT(LearnedWord, kind, word, examples, mean, scatter)
CASTOR_REFLECT(LearnedWords, words)

} // namespace castor::vision
