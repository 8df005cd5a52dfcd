#pragma once

#include "castor/tests/communication/picture_scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// Statements of people about pictures of three boxes with shapes (A. Suhr, M. Lewis, J. Yeh and
/// Y. Artzi, A corpus of natural language for visual reasoning, ACL 2017).
namespace castor::nlvr {

struct Statement {
  std::string sentence;
  bool is_true = false;
  std::string identifier;
  /// The part of the data that it belongs to: "0" to "5".
  std::string directory;
  communication::test::PictureScene scene;
};

/// The statements of a file of records, one a line, in its order. The scenes are as drawn.
///
/// \throws std::runtime_error if the file cannot be read
std::vector<Statement> read_statements(const std::filesystem::path& file);

} // namespace castor::nlvr
