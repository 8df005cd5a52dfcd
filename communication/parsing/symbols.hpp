#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace castor::communication {

/// Number of an interned text: a category, a sort, a proposition... 0 for none.
using Symbol = std::uint32_t;

/// Interned texts and their numbers.
class SymbolTable {
public:
  SymbolTable();
  SymbolTable(const SymbolTable&) = delete;
  SymbolTable& operator=(const SymbolTable&) = delete;

  /// The number of `text`, a new one if it is not known.
  Symbol intern(std::string_view text);

  /// The number of `text`, 0 if it is not known or empty.
  Symbol find(std::string_view text) const;

  const std::string& text(Symbol symbol) const { return texts_[symbol]; }

  Symbol size() const { return static_cast<Symbol>(texts_.size()); }

private:
  /// A deque, because the keys of the map point into it.
  std::deque<std::string> texts_;
  std::unordered_map<std::string_view, Symbol> numbers_;
};

} // namespace castor::communication
