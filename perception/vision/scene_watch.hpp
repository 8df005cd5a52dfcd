#pragma once

#include "castor/perception/vision/types.hpp"

#include <optional>

namespace castor::vision {

struct SceneWatchOptions {
  /// A pixel has changed if its grey level differs by more than this from the last frame; of 255.
  int pixel_threshold = 20;
  /// A frame has changed if more than this share of its pixels have.
  double changed_share = 0.003;
  /// Or if a square of this many pixels a side has changed all over: a thing of 1 cm has come or
  /// gone, unlike the pixels of noise, which are scattered. 0: squares do not count.
  int changed_square = 4;
  /// Number of frames without change after which the scene is still.
  int still_frames = 3;
  /// Whether the first frame counts as a change.
  bool first_frame_counts = true;
};

/// Detects from the differences between frames that a scene changes and comes to rest again. The
/// rule and its numbers are those of the original system's change detector, except for
/// `changed_square`.
class SceneWatch {
public:
  explicit SceneWatch(SceneWatchOptions options = {}) : options_(options) {}

  /// New state of the scene after this frame: that it is changing, or once that it has changed and
  /// is still; otherwise nothing. A frame of another size counts as changed.
  std::optional<SceneChanged> observe(const Image& frame);

private:
  bool differs(const Image& grey) const;

  SceneWatchOptions options_;
  /// The last frame in grey.
  std::optional<Image> last_;
  bool something_happened_ = false;
  int countdown_ = 0;
};

} // namespace castor::vision
