#include "castor/communication/parsing/symbols.hpp"

namespace castor::communication {

SymbolTable::SymbolTable() {
  intern("");
}

Symbol SymbolTable::intern(std::string_view text) {
  if (const auto known = numbers_.find(text); known != numbers_.end())
    return known->second;
  const auto symbol = size();
  texts_.emplace_back(text);
  numbers_.emplace(texts_.back(), symbol);
  return symbol;
}

Symbol SymbolTable::find(std::string_view text) const {
  const auto known = numbers_.find(text);
  return known == numbers_.end() ? 0 : known->second;
}

} // namespace castor::communication
