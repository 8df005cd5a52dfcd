// A process that meets an entry whose C++ type it does not have. It reads a self-described value
// from standard input and, from bytes and descriptor alone,
//
//   opaque_process json                     prints it
//   opaque_process compare FIELD OP TEXT    prints whether "FIELD OP TEXT" is true of it
//   opaque_process where PREDICATE          prints whether the predicate is true of it
//   opaque_process echo                     writes it to standard output again
//
// Ends with 1 and a message on standard error if it cannot.

#include "castor/wm/filters/predicate.hpp"
#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/json.hpp"
#include "castor/wm/values/value.hpp"

#include <charconv>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

castor::Comparison comparison(std::string_view text) {
  using castor::Comparison;
  for (auto [name, op] :
       {std::pair{"==", Comparison::equal}, std::pair{"!=", Comparison::not_equal},
        std::pair{"<", Comparison::less}, std::pair{"<=", Comparison::less_equal},
        std::pair{">", Comparison::greater}, std::pair{">=", Comparison::greater_equal}})
    if (text == name)
      return op;
  throw std::invalid_argument("no comparison: " + std::string{text});
}

template <class T>
bool parse(std::string_view text, castor::FieldValue& out) {
  T x{};
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc{} || end != text.data() + text.size())
    return false;
  out = x;
  return true;
}

/// The text as a value of the kind it is to be compared with.
castor::FieldValue literal(std::string_view text, const castor::FieldValue& field) {
  castor::FieldValue result = std::string{text};
  if (std::holds_alternative<bool>(field) && (text == "true" || text == "false"))
    result = text == "true";
  else if (!std::holds_alternative<std::string>(field) && !std::holds_alternative<bool>(field))
    parse<std::int64_t>(text, result) || parse<std::uint64_t>(text, result) ||
      parse<double>(text, result);
  return result;
}

void run(const std::vector<std::string>& arguments) {
  castor::Bytes input{std::istreambuf_iterator<char>{std::cin}, {}};
  auto value = castor::decode_self_described(input);
  if (arguments == std::vector<std::string>{"json"}) {
    std::cout << castor::to_json(value);
  } else if (arguments == std::vector<std::string>{"echo"}) {
    auto output = castor::encode_self_described(value);
    std::cout.write(reinterpret_cast<const char*>(output.data()),
                    static_cast<std::streamsize>(output.size()));
  } else if (arguments.size() == 2 && arguments[0] == "where") {
    auto predicate = castor::Predicate::parse(arguments[1]);
    predicate.check(value.type());
    std::cout << (predicate.matches(value) ? "true" : "false");
  } else if (arguments.size() == 4 && arguments[0] == "compare") {
    auto field = castor::read_field(value.type(), value.bytes(), arguments[1]);
    bool result = castor::compare(field, comparison(arguments[2]), literal(arguments[3], field));
    std::cout << (result ? "true" : "false");
  } else {
    throw std::invalid_argument(
      "usage: opaque_process json | echo | where PREDICATE | compare FIELD OP TEXT");
  }
}

} // namespace

int main(int argc, char** argv) {
  try {
    run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    std::cerr << "opaque_process: " << e.what() << '\n';
    return 1;
  }
}
