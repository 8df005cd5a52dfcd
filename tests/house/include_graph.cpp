#include "castor/tests/house/include_graph.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

namespace castor::test {

namespace {

namespace fs = std::filesystem;

/// What a line includes of Castor's, without "castor/".
std::optional<std::string> included(const std::string& line) {
  for (std::string begin : {"#include \"castor/", "#include <castor/"})
    if (line.starts_with(begin))
      return line.substr(begin.size(), line.find_first_of("\">", begin.size()) - begin.size());
  return std::nullopt;
}

std::vector<std::string> includes_of(const fs::path& file) {
  std::ifstream in{file};
  if (!in)
    throw std::runtime_error(file.string() + " cannot be read");
  std::vector<std::string> result;
  for (std::string line; std::getline(in, line);)
    if (auto x = included(line))
      result.push_back(*std::move(x));
  return result;
}

bool is_source(const fs::path& file) {
  return file.extension() == ".hpp" || file.extension() == ".cpp";
}

/// The innermost of the folders that a file is in; empty if it is in none.
std::string module_of(const std::string& file, const Modules& modules) {
  for (auto folder = fs::path{file}.parent_path(); !folder.empty(); folder = folder.parent_path())
    if (modules.count(folder.string()) > 0)
      return folder.string();
  return {};
}

std::string without_extension(const std::string& file) {
  return fs::path{file}.replace_extension().string();
}

/// Tarjan's strongly connected components.
class CircleSearch {
public:
  explicit CircleSearch(const IncludeGraph& graph) {
    for (auto& [file, includes] : graph)
      for (auto& x : includes)
        edges_[without_extension(file)].insert(without_extension(x));
  }

  std::vector<std::vector<std::string>> run() {
    for (auto& [x, to] : edges_)
      if (numbers_.count(x) == 0)
        visit(x);
    std::sort(circles_.begin(), circles_.end());
    return std::move(circles_);
  }

private:
  std::size_t visit(const std::string& x) {
    auto number = numbers_[x] = numbers_.size();
    auto lowest = number;
    path_.push_back(x);
    if (auto i = edges_.find(x); i != edges_.end())
      for (auto& to : i->second) {
        if (numbers_.count(to) == 0)
          lowest = std::min(lowest, visit(to));
        else if (std::find(path_.begin(), path_.end(), to) != path_.end())
          lowest = std::min(lowest, numbers_[to]);
      }
    if (lowest == number) {
      auto begin = std::find(path_.begin(), path_.end(), x);
      if (path_.end() - begin > 1) {
        circles_.emplace_back(begin, path_.end());
        std::sort(circles_.back().begin(), circles_.back().end());
      }
      path_.erase(begin, path_.end());
    }
    return lowest;
  }

  std::map<std::string, std::set<std::string>> edges_;
  std::map<std::string, std::size_t> numbers_;
  /// Visited, and in no component yet.
  std::vector<std::string> path_;
  std::vector<std::vector<std::string>> circles_;
};

} // namespace

std::vector<std::string> product_folders(const fs::path& root) {
  static const std::set<std::string> others{"benchmarks", "build", "docs", "tests"};
  std::vector<std::string> result;
  for (auto& x : fs::directory_iterator(root)) {
    auto name = x.path().filename().string();
    if (x.is_directory() && !name.starts_with('.') && others.count(name) == 0)
      result.push_back(name);
  }
  return result;
}

IncludeGraph include_graph(const fs::path& root, const std::vector<std::string>& folders) {
  IncludeGraph result;
  for (auto& folder : folders)
    for (auto& x : fs::recursive_directory_iterator(root / folder))
      if (is_source(x.path()))
        result[fs::relative(x.path(), root).string()] = includes_of(x.path());
  return result;
}

std::vector<std::string> forbidden_includes(const IncludeGraph& graph, const Modules& modules) {
  std::vector<std::string> result;
  for (auto& [file, includes] : graph) {
    auto module = module_of(file, modules);
    if (module.empty())
      continue;
    for (auto& x : includes)
      if (auto other = module_of(x, modules);
          other != module && modules.at(module).count(other) == 0)
        result.push_back(file + " includes " + x);
  }
  return result;
}

std::vector<std::vector<std::string>> circles(const IncludeGraph& graph) {
  return CircleSearch{graph}.run();
}

} // namespace castor::test
