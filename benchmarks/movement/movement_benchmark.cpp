// How a robot moves among people: GoalPursuit with a simulated body that knows its pose, and random
// goals where the robot fits.
//
//     movement_benchmark [WORLD] [VARIABLE=NUMBER...]
//
// WORLD is the file of a building (the office by default), the .yaml of a map, or generated, which
// is another building for each seed. Variables: seeds (10), first (1), goals (50), people (10),
// laser (180, degrees), legs (0), fitting (1; 0: goals are any free cells). With write=FILE it
// writes the building with the people of the first seed, for `castor run`, and does nothing else.

#include "castor/benchmarks/movement/crowd.hpp"
#include "castor/benchmarks/movement/movement_run.hpp"
#include "castor/mapping/building/building_text.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace castor::benchmark {

namespace {

void write_building(const std::string& name, const std::map<std::string, double>& variables,
                    const std::string& file) {
  const auto seed = static_cast<std::uint64_t>(variables.at("first"));
  const MovementWorld world(name, seed);
  if (!world.building())
    throw std::invalid_argument("a map has no people to write: name a building");
  auto building = *world.building();
  building.people = crowd(world.map(), {world.start().x, world.start().y},
                          static_cast<int>(variables.at("people")), seed);
  std::ofstream{file} << mapping::building_text(building);
}

void run(const std::string& name, const std::map<std::string, double>& variables) {
  const auto number = [&](const std::string& variable) {
    return static_cast<int>(variables.at(variable));
  };
  MovementRunOptions options;
  options.goals = number("goals");
  options.people = number("people");
  options.fitting = number("fitting") != 0;
  options.body.laser.field_of_view = number("laser");
  options.body.legs = number("legs") != 0;
  for (int i = 0; i < number("seeds"); ++i) {
    options.seed = static_cast<std::uint64_t>(number("first") + i);
    const MovementWorld world(
      name == "generated" ? "generated:" + std::to_string(options.seed) : name, options.seed);
    const auto begun = std::chrono::steady_clock::now();
    const auto result = run_movement(world, options);
    fmt::print("seed {}, {:.0f} s in {:.0f} s: {}\n", options.seed, result.time,
               std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(),
               result.tally.text());
    for (const auto& x : result.remarks)
      fmt::print("    {}\n", x);
    std::fflush(stdout);
  }
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  std::string world = CASTOR_CONFIGS "/buildings/office.building";
  std::map<std::string, double> variables{{"seeds", 10},  {"first", 1},   {"goals", 50},
                                          {"people", 10}, {"laser", 180}, {"legs", 0},
                                          {"fitting", 1}};
  std::string file;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      const auto equals = word.find('=');
      if (equals == word.npos)
        world = word;
      else if (word.starts_with("write="))
        file = word.substr(equals + 1);
      else
        variables.at(word.substr(0, equals)) = std::stod(word.substr(equals + 1));
    }
    if (file.empty())
      castor::benchmark::run(world, variables);
    else
      castor::benchmark::write_building(world, variables, file);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
