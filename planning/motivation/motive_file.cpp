#include "castor/planning/motivation/motive_file.hpp"

#include "castor/base/file_access.hpp"

#include <cstddef>
#include <stdexcept>

namespace castor::planning {

std::vector<MotiveTemplate> load_motives(const std::string& file) {
  constexpr std::size_t most_bytes = std::size_t{1} << 20;
  auto content = read_file(file, most_bytes);
  if (!content.text)
    throw std::runtime_error("the motives in " + file + " cannot be read: " + content.error +
                             "; give a file of motives with --motives");
  auto read = parse_motives(file, *content.text);
  if (has_errors(read.problems))
    throw std::runtime_error(render(read.problems));
  return std::move(read.templates);
}

} // namespace castor::planning
