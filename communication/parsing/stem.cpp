#include "castor/communication/parsing/stem.hpp"

#include <libstemmer.h>

#include <memory>
#include <new>

namespace castor::communication {

std::string stem_of(const std::string& word) {
  // A stemmer writes to a buffer of its own.
  thread_local const std::unique_ptr<sb_stemmer, decltype(&sb_stemmer_delete)> stemmer{
    sb_stemmer_new("english", "UTF_8"), &sb_stemmer_delete};
  if (!stemmer)
    throw std::bad_alloc{};
  const auto* stem = sb_stemmer_stem(stemmer.get(), reinterpret_cast<const sb_symbol*>(word.data()),
                                     static_cast<int>(word.size()));
  if (stem == nullptr)
    throw std::bad_alloc{};
  return {reinterpret_cast<const char*>(stem),
          static_cast<std::size_t>(sb_stemmer_length(stemmer.get()))};
}

} // namespace castor::communication
