#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace castor::timeline {

/// Is this the id of an entry?
using IsId = std::function<bool(const std::string&)>;

/// The most telling of an entry's content, the most telling first: what is said, words and their
/// confidences, which entries it leads to, what is true, numbers; long lists are counted, and what
/// is empty, zero or a time is left out. Pictures are for others to show.
std::vector<std::string> summary(const nlohmann::ordered_json& content, const IsId& is_id);

} // namespace castor::timeline
