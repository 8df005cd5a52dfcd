#include "castor/tools/cli/table.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <utility>

namespace castor::cli {

namespace {

/// As many as a terminal shows: the bytes that begin a character.
std::size_t width(const std::string& x) {
  return static_cast<std::size_t>(
    std::count_if(x.begin(), x.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

} // namespace

Table::Table(std::vector<std::string> headings) {
  for (auto& x : headings) {
    right_.push_back(x.starts_with('>'));
    if (right_.back())
      x.erase(0, 1);
  }
  add(std::move(headings));
}

void Table::add(std::vector<std::string> row) {
  row.resize(right_.size());
  for (auto& cell : row)
    cell = printable(cell);
  rows_.push_back({std::move(row), {}});
}

void Table::remark(std::string text) {
  rows_.push_back({{}, printable(on_one_line(text))});
}

std::string Table::text() const {
  std::vector<std::size_t> widths(right_.size());
  for (auto& row : rows_)
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      widths[i] = std::max(widths[i], width(row.cells[i]));
  std::string result;
  for (auto& row : rows_) {
    std::string line = row.remark.empty() ? "" : "  " + row.remark;
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      std::string space(widths[i] - width(row.cells[i]), ' ');
      line += (i > 0 ? "  " : "") + (right_[i] ? space + row.cells[i] : row.cells[i] + space);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + '\n';
  }
  return result;
}

} // namespace castor::cli
