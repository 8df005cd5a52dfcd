#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// Word that stands for any numeral in phrases of the lexicon and of paraphrases.
inline constexpr std::string_view any_numeral = "0.0";

/// Whether the word is a number in digits: "7", "5.5".
bool is_numeral(std::string_view word);

/// A number in digits, with two decimals at most.
std::string numeral(double value);

/// A number of centimetres in metres; 0 for what is no number.
double metres_of_centimetres(std::string_view number);

/// Numbers above twelve, and those with halves, in digits, and so are all lengths, which are in
/// centimetres and without "about" and the like: "about forty-five mm" is "4.5 cm", "two and a half
/// centimetres" is "2.5 cm". Other words stay.
std::vector<std::string> with_numerals(std::vector<std::string> words);

} // namespace castor::communication
