#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types of the vision working memory, its only interface to other subarchitectures.
namespace castor::vision {

using geometry::AlignedBox;
using geometry::Camera;
using geometry::Point2;
using geometry::Point3;
using geometry::Pose;
using geometry::Rotation;

/// An image in rows from the top; `bytes` has width * height * channels of them, 3 channels are B,
/// G, R.
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

/// One hypothesis about a property, such as a colour: its name and a confidence in [0, 1].
struct Hypothesis {
  std::string value = "unknown";
  double confidence = 0;

  friend bool operator==(const Hypothesis&, const Hypothesis&) = default;
};

/// A frame that a camera component delivers by pull or push; never an entry.
struct CameraFrame {
  Image image;
  Camera camera;
  /// Time of the image, microseconds since the system began.
  std::int64_t time = 0;
  /// Number of earlier frames.
  std::uint64_t index = 0;
};

/// State of the scene: it is changing, it has come to rest changed, or that change was processed.
/// One entry per camera, which is added once and then overwritten.
struct SceneChanged {
  bool changing = false;
  bool changed = false;
  bool processed = false;
  std::int32_t camera = 0;
};

/// While an entry of this type exists, vision does not process the scene: pictures taken meanwhile
/// count for nothing. Added by whoever moves an arm through the picture, to vision's working
/// memory, before it moves, and deleted when the arm is away; ephemeral, so that it ends with its
/// creator.
struct InhibitSceneProcessing {
  /// Who inhibits, for people.
  std::string component;
};

/// Features that the feature extractor adds to a region: evidence, not decisions.
struct RegionFeatures {
  /// Colour names, the likeliest first.
  std::vector<Hypothesis> colours;
  /// Shape names, the likeliest first.
  std::vector<Hypothesis> shapes;
  /// Evidence for learned colours: L*, a* and b* of the paint.
  std::vector<double> colour_evidence;
  /// Evidence for shapes, in the order of measure_shape().
  std::vector<double> shape_evidence;
  /// Position and size of the region on the table, in the frame of the camera's pose; all zero
  /// without a calibration.
  AlignedBox extent;
  /// Whether the extent was measured with a camera that is not calibrated: lengths are a guess
  /// then.
  bool is_extent_assumed = false;
  /// Of the cube, cylinder or sphere itself, however it is turned: along its own x, y and z,
  /// metres; all zero if its outline does not tell.
  Point3 lengths;
};

/// Small picture of the scene when it was last processed, with names on the objects, for users. One
/// entry per camera with this option, which is added once and then overwritten.
struct ScenePicture {
  Image image;
  std::int32_t camera = 0;
  /// Time of the image, microseconds since the system began.
  std::int64_t time = 0;
};

/// A region of interest: a part of an image that differs from the background.
struct ROI {
  ImageBox box;
  /// The pixels in `box` (3 channels), and the mask of the region (1 channel, 0 or 255).
  Image region;
  Image mask;
  /// The outline in image coordinates.
  std::vector<Point2> contour;
  std::int32_t camera = 0;
  /// Time of the image, microseconds since the system began.
  std::int64_t time = 0;
  /// The SceneObject that this is a view of; empty while unknown.
  std::string object_id;
  /// False until the feature extractor has processed the region.
  bool has_features = false;
  RegionFeatures features;
};

/// An object on the table: the vision system's best hypothesis about it.
struct SceneObject {
  std::int64_t time = 0;
  AlignedBox box;
  /// Of the solid itself, however it is turned, metres; all zero if they are not known.
  Point3 lengths;
  Pose pose;
  Hypothesis label;
  Hypothesis colour;
  Hypothesis shape;
  Hypothesis size;
  std::vector<std::string> roi_ids;
  /// The only component that may delete the object and its regions.
  std::string managing_process;
};

/// What somebody remembers of an object while something stands on it, so that vision sees only a
/// part of it, which may look like another shape. Its id is `partly_seen` of that object.
struct PartlySeen {
  std::string object_id;
  /// As of a SceneObject, for certain; empty, or all zero, if it is not known.
  std::string colour;
  std::string shape;
  std::string size;
  Point3 lengths;

  friend bool operator==(const PartlySeen&, const PartlySeen&) = default;
};

inline std::string partly_seen(const std::string& object_id) {
  return "partly seen: " + object_id;
}

/// Changes of a SceneObject; added with every overwrite of one.
struct SceneObjectUpdate {
  std::string object_id;
  bool position = false;
  bool shape = false;
  bool size = false;
  bool colour = false;
  bool label = false;
};

/// Attribute of an object: a word for its "colour" or its "shape".
struct Attribute {
  std::string kind;
  Hypothesis value;
};

/// Instruction to learn words for an object. Added by a component that knows the words; deleted by
/// the learner that has processed it.
struct LearnInstruction {
  /// Whether a tutor gave the words; otherwise the robot inferred them.
  bool tutor_initiated = true;
  /// The SceneObject or ROI concerned.
  std::string target_id;
  std::vector<Attribute> attributes;
};

/// A learned word and the statistics of its examples.
struct LearnedWord {
  std::string kind;
  std::string word;
  /// Number of examples, weighted by the tutor's confidence.
  double examples = 0;
  /// Mean of their evidence.
  std::vector<double> mean;
  /// Sum of the squared distances of their evidence from the mean.
  double scatter = 0;

  friend bool operator==(const LearnedWord&, const LearnedWord&) = default;
};

/// All words of the learner, for components that name objects. A single entry.
struct LearnedWords {
  std::vector<LearnedWord> words;
};

CASTOR_REFLECT(Image, width, height, channels, bytes)
CASTOR_REFLECT(ImageBox, center, width, height)
CASTOR_REFLECT(Hypothesis, value, confidence)
CASTOR_REFLECT(CameraFrame, image, camera, time, index)
CASTOR_REFLECT(SceneChanged, changing, changed, processed, camera)
CASTOR_REFLECT(InhibitSceneProcessing, component)
CASTOR_REFLECT(ScenePicture, image, camera, time)
CASTOR_REFLECT(RegionFeatures, colours, shapes, colour_evidence, shape_evidence, extent,
               is_extent_assumed, lengths)
CASTOR_REFLECT(ROI, box, region, mask, contour, camera, time, object_id, has_features, features)
CASTOR_REFLECT(SceneObject, time, box, lengths, pose, label, colour, shape, size, roi_ids,
               managing_process)
CASTOR_REFLECT(PartlySeen, object_id, colour, shape, size, lengths)
CASTOR_REFLECT(SceneObjectUpdate, object_id, position, shape, size, colour, label)
CASTOR_REFLECT(Attribute, kind, value)
CASTOR_REFLECT(LearnInstruction, tutor_initiated, target_id, attributes)
CASTOR_REFLECT(LearnedWord, kind, word, examples, mean, scatter)
CASTOR_REFLECT(LearnedWords, words)

} // namespace castor::vision
