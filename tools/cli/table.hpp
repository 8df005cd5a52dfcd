#pragma once

#include <string>
#include <vector>

namespace castor::cli {

/// Text in columns as wide as their widest cells.
class Table {
public:
  /// A heading that begins with '>' makes its column right-aligned, for numbers.
  explicit Table(std::vector<std::string> headings);

  void add(std::vector<std::string> row);

  /// Adds an indented line below the last row.
  void remark(std::string text);

  /// Whether there are no rows below the headings.
  bool empty() const { return rows_.size() <= 1; }

  /// Every line ends with a line break.
  std::string text() const;

private:
  struct Row {
    std::vector<std::string> cells;
    std::string remark;
  };

  std::vector<bool> right_;
  std::vector<Row> rows_;
};

} // namespace castor::cli
