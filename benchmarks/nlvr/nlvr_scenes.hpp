#pragma once

#include "castor/tests/communication/picture_scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// Statements of people about pictures of three boxes with shapes (A. Suhr, M. Lewis, J. Yeh and
/// Y. Artzi, A corpus of natural language for visual reasoning, ACL 2017).
namespace castor::nlvr {

/// What is in a box.
using Items = std::vector<communication::test::PicturedItem>;

/// How wide and high boxes are taken to be, metres.
inline constexpr double box_side = 0.1;

struct Statement {
  std::string sentence;
  bool is_true = false;
  std::string identifier;
  /// The part of the data that it belongs to: "0" to "5".
  std::string directory;
  /// The boxes as drawn, from left to right.
  std::vector<Items> boxes;
};

/// The statements of a file of records, one a line, in its order.
///
/// \throws std::runtime_error if the file cannot be read
std::vector<Statement> read_statements(const std::filesystem::path& file);

/// Boxes side by side. Their items are towers if those of each box are blocks of one size above
/// each other, from the floor on.
communication::test::PictureScene scene_of(const std::vector<Items>& boxes);

} // namespace castor::nlvr
