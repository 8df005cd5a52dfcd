#include "castor/base/source_location.hpp"

#include <utility>

namespace castor {

SourceLocation::SourceLocation(std::shared_ptr<const SourceUnit> unit, std::size_t line,
                               std::uint64_t order)
  : unit_(std::move(unit)), line_(static_cast<std::uint32_t>(line)), order_(order) {
  // nop
}

SourceLocation::SourceLocation(std::string file, std::size_t line)
  : SourceLocation(std::make_shared<const SourceUnit>(SourceUnit{std::move(file), {}}), line) {
  // nop
}

const std::string& SourceLocation::file() const noexcept {
  static const std::string unknown;
  return unit_ ? unit_->file : unknown;
}

std::vector<IncludeSite> SourceLocation::include_chain() const {
  std::vector<IncludeSite> chain;
  for (auto unit = unit_.get(); unit != nullptr && unit->included_from.unit_ != nullptr;
       unit = unit->included_from.unit_.get())
    chain.push_back({unit->included_from.file(), unit->included_from.line()});
  return chain;
}

bool operator==(const SourceLocation& a, const SourceLocation& b) {
  return a.line_ == b.line_ &&
         (a.unit_ == b.unit_ || (a.file() == b.file() && a.include_chain() == b.include_chain()));
}

std::string to_string(const SourceLocation& where) {
  if (where.line() == 0)
    return where.file();
  return where.file() + ":" + std::to_string(where.line());
}

} // namespace castor
