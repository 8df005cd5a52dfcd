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

/// Whether it is a part of the table that things can be seen to be in. That something was given to
/// somebody, "at-hand", is known by what was done.
bool is_seen_part(std::string_view relation);

/// Parts of the table that a goal speaks of and that things can be seen in.
std::vector<std::string> parts_in(std::string_view goal);

} // namespace castor::planning
