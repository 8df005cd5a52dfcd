#include "castor/planning/tabletop/refusals.hpp"

#include "castor/planning/motivation/failure_words.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace castor::planning {

namespace {

bool is_in_way(const Refusal& x, const std::string& thing) {
  return std::ranges::find(x.in_way, thing) != x.in_way.end();
}

bool is_letter(char x) {
  return std::isalpha(static_cast<unsigned char>(x)) != 0;
}

std::string listed(const std::vector<std::string>& names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return result;
}

/// What people could ask for instead; empty if that is not known.
std::string help_for(std::string_view reason) {
  const auto says = [reason](std::string_view words) {
    return reason.find(words) != std::string_view::npos;
  };
  if (says("place is out of reach") || says("reach any such place"))
    return "Tell me another place.";
  if (says("is out of reach"))
    return "Move it nearer to me.";
  return says("too large or too flat for the gripper") ? "I may be able to push it." : "";
}

} // namespace

Explanation explanation_of(const std::vector<Refusal>& refusals) {
  std::string most_in_way;
  std::ptrdiff_t most = 0;
  for (const auto& x : refusals)
    for (const auto& thing : x.in_way)
      if (const auto count =
            std::ranges::count_if(refusals, [&](const auto& y) { return is_in_way(y, thing); });
          count > most) {
        most = count;
        most_in_way = thing;
      }
  if (most > 0 && 2 * static_cast<std::size_t>(most) >= refusals.size()) {
    // With as few others in the way as possible.
    const Refusal* best = nullptr;
    for (const auto& x : refusals)
      if (is_in_way(x, most_in_way) && (best == nullptr || x.in_way.size() < best->in_way.size()))
        best = &x;
    return {best->reason, "Take " + listed(best->in_way) + " away first.", best->in_way_ids};
  }
  const Refusal* best = nullptr;
  most = 0;
  for (const auto& x : refusals)
    if (const auto count = std::ranges::count(refusals, x.reason, &Refusal::reason); count > most) {
      most = count;
      best = &x;
    }
  return best == nullptr ? Explanation{} : Explanation{best->reason, help_for(best->reason)};
}

Explanation explanation_of_planning(std::string_view reason) {
  return {failure_in_words(reason),
          reason.starts_with("there is no plan")    ? "Tell me what to move before."
          : reason.starts_with("no plan was found") ? "Ask me for one thing after the other."
                                                    : ""};
}

std::string with_joints(std::string reason, const std::vector<std::string>& joints) {
  for (const auto& joint : joints)
    if (reason.find("joint " + joint) == std::string::npos)
      reason += "; the arm's joint " + joint + " does not move any more";
  return reason;
}

std::string with_words(std::string_view text, const std::map<std::string, std::string>& words) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    auto end = at;
    while (end < text.size() && is_letter(text[end]))
      ++end;
    const auto known = words.find(std::string{text.substr(at, end - at)});
    if (known != words.end())
      result += known->second;
    else
      result += text.substr(at, std::max<std::size_t>(end - at, 1));
    at = std::max(end, at + 1);
  }
  return result;
}

} // namespace castor::planning
