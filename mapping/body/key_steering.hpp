#pragma once

#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <string_view>

namespace castor::mapping {

struct KeySteeringOptions {
  /// What a key changes, m/s and rad/s.
  double forward_step = 0.1;
  double turn_step = 0.2;
  double max_forward = 0.6;
  double max_turn = 1.2;
};

/// Velocity of a robot that is steered by keys: w or up faster, s or down slower and backwards, a
/// or left and d or right for turns, x straight on, the space bar to stop, q to end.
class KeySteering {
public:
  explicit KeySteering(const KeySteeringOptions& options) : options_(options) {
    // nop
  }

  /// Takes what the terminal sends, which may be a part of a key's sequence; other keys are
  /// ignored.
  void take(std::string_view characters);

  const Twist2& velocity() const { return velocity_; }
  bool is_ended() const { return is_ended_; }

private:
  void press(char key);

  KeySteeringOptions options_;
  Twist2 velocity_;
  bool is_ended_ = false;
  /// Characters of the sequence ESC [ A that were taken.
  std::uint8_t escape_ = 0;
};

} // namespace castor::mapping
