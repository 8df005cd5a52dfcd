#pragma once

#include "castor/base/statement_words.hpp"
#include "castor/mapping/building/building.hpp"

#include <string>
#include <vector>

/// Parsers of the statements of a building's file, for building_file.hpp.
namespace castor::mapping {

/// First words of statements.
const std::vector<std::string>& building_keywords();

// Each parses the rest of a line, after its first word.
// \throws StatementError

/// X Y to X Y [to X Y ...] [close] [thickness T]
/// @param thickness of walls that do not say
std::vector<Wall> read_walls(StatementWords& words, double thickness);

/// NAME at X Y [width W] [open|shut]
Door read_door(StatementWords& words);

/// NAME at X Y [kind KIND]
Room read_room(StatementWords& words);

/// KIND at X Y box LENGTH WIDTH HEIGHT | disc DIAMETER HEIGHT [on Z] [turned DEGREES]
/// [colour COLOUR] [legs] [name=NAME]
Furniture read_furniture(StatementWords& words);

/// KIND at X Y [size DIAMETER HEIGHT] [on Z] [colour COLOUR] [name=NAME]
BuildingObject read_building_object(StatementWords& words);

/// NAME route X Y to X Y [to X Y ...] [loop] [speed S]
Walker read_walker(StatementWords& words);

/// X Y [heading DEGREES]
Pose2 read_start(StatementWords& words);

} // namespace castor::mapping
