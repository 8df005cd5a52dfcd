#include "castor/mapping/body/key_steering.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

namespace {

/// The sum without what is left of rounding, so that steps there and back are zero.
double stepped(double x, double step, double limit) {
  const double sum = std::clamp(x + step, -limit, limit);
  return std::abs(sum) < std::abs(step) / 2 ? 0 : sum;
}

} // namespace

void KeySteering::take(std::string_view characters) {
  constexpr char escape = '\x1b';
  for (char c : characters) {
    if (c == escape)
      escape_ = 1;
    else if (escape_ == 1 && (c == '[' || c == 'O'))
      escape_ = 2;
    else if (escape_ == 2) {
      escape_ = 0;
      constexpr std::string_view arrows = "ABCD";
      constexpr std::string_view letters = "wsda";
      if (auto i = arrows.find(c); i != arrows.npos)
        press(letters[i]);
    } else {
      escape_ = 0;
      press(c);
    }
  }
}

void KeySteering::press(char key) {
  switch (key) {
    case 'w':
      velocity_.forward = stepped(velocity_.forward, options_.forward_step, options_.max_forward);
      break;
    case 's':
      velocity_.forward = stepped(velocity_.forward, -options_.forward_step, options_.max_forward);
      break;
    case 'a':
      velocity_.turn = stepped(velocity_.turn, options_.turn_step, options_.max_turn);
      break;
    case 'd':
      velocity_.turn = stepped(velocity_.turn, -options_.turn_step, options_.max_turn);
      break;
    case 'x':
      velocity_.turn = 0;
      break;
    case ' ':
      velocity_ = {};
      break;
    case 'q':
      velocity_ = {};
      is_ended_ = true;
      break;
    default:
      break;
  }
}

} // namespace castor::mapping
