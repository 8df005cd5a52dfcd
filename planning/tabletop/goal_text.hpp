#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What the text of a goal speaks of: "(and (in-part ball left))".
namespace castor::planning {

/// Whether a word is in it, such as the name of a thing.
bool contains_word(std::string_view text, std::string_view word);

/// Whether a goal says of a thing itself where it is to be: "(near ball box)" does of the ball.
bool is_subject(std::string_view goal, std::string_view thing);

/// The waypoint that a goal says a thing is to be at; empty if it says none.
std::string_view waypoint_wanted(std::string_view goal, std::string_view thing);

/// Parts of the table that a goal speaks of and that things can be seen in.
std::vector<std::string> parts_in(std::string_view goal);

} // namespace castor::planning
