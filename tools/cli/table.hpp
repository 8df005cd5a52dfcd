#pragma once

#include <string>
#include <vector>

namespace castor::cli {

/// Text in columns as wide as what stands in them.
class Table {
public:
  /// A heading that begins with '>' is that of a column of numbers, which stand at its right.
  explicit Table(std::vector<std::string> headings);

  void add(std::vector<std::string> row);

  /// A line of its own below the last row, indented.
  void remark(std::string text);

  /// It has nothing but headings.
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
