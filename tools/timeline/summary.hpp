#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace castor::timeline {

/// Whether a string is the id of an entry.
using IsId = std::function<bool(const std::string&)>;

/// Summary of an entry's content, the most informative lines first: utterances, words and their
/// confidences, references to entries, flags that are true, numbers. Long lists are counted; empty
/// and zero values and times are left out. Pictures are not included.
std::vector<std::string> summary(const nlohmann::ordered_json& content, const IsId& is_id);

} // namespace castor::timeline
