#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

/// What an arm has found out to be in the way of things that it could not move; by their names.
class ThingsInWay {
public:
  /// A thing could not be moved because of others. Where one of them could not be moved before,
  /// that does not count: none of them would be the first; nor where one of them was moved for it
  /// twice.
  void refused(const std::string& thing, std::vector<std::string> in_way);

  /// It is somewhere else now.
  void moved(const std::string& thing);

  void clear();

  /// "(in-way box ball)": the box has to be moved before the ball.
  /// @param is_movable whether a thing may be moved for that; none of several is if one may not
  std::vector<std::string> facts(const std::function<bool(const std::string&)>& is_movable) const;

private:
  std::map<std::string, std::vector<std::string>> in_way_;
  /// How often the second was moved because it was in the way of the first.
  std::map<std::pair<std::string, std::string>, int> moved_for_;
};

} // namespace castor::planning
