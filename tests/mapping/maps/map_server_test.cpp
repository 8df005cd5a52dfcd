// Map files of ROS's map_server.

#include "castor/mapping/maps/map_file_error.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <fstream>
#include <string>

namespace castor::mapping::test {

namespace {

using castor::test::TemporaryFolder;
using testing::HasSubstr;

constexpr const char* good = "image: map.pgm\n"
                             "resolution: 0.1\n"
                             "origin: [-1.5, 2, 0.25]\n"
                             "negate: 0\n"
                             "occupied_thresh: 0.65\n"
                             "free_thresh: 0.196\n";

/// The good text with a line replaced; an empty one is removed.
std::string with(const std::string& key, const std::string& line) {
  std::string text = good;
  auto begin = text.find(key + ":");
  auto end = text.find('\n', begin);
  return text.replace(begin, end - begin + (line.empty() ? 1 : 0), line);
}

std::string problem_of(const std::string& text) {
  try {
    parse_map_server(text, "map.yaml");
  } catch (const MapFileError& e) {
    return e.what();
  }
  return "no problem";
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A map of one row from the grey values of its pixels.
std::vector<int> cells_of(const std::string& settings, const std::vector<int>& pixels) {
  TemporaryFolder folder;
  write(folder / "map.yaml", settings);
  auto image = "P5\n" + std::to_string(pixels.size()) + " 1\n255\n";
  for (auto x : pixels)
    image.push_back(static_cast<char>(x));
  write(folder / "map.pgm", image);
  auto map = read_map_server(folder / "map.yaml");
  return {map.cells.begin(), map.cells.end()};
}

TEST(MapServer, ParsesItsKeys) {
  auto x = parse_map_server(good, "map.yaml");
  EXPECT_EQ(x.image, "map.pgm");
  EXPECT_EQ(x.resolution, 0.1);
  EXPECT_EQ(x.origin, (Pose2{-1.5, 2, 0.25}));
  EXPECT_FALSE(x.negate);
  EXPECT_EQ(x.occupied_threshold, 0.65);
  EXPECT_EQ(x.free_threshold, 0.196);
  EXPECT_EQ(x.mode, MapMode::trinary);
}

TEST(MapServer, AcceptsTheFormsOfYaml) {
  auto x =
    parse_map_server("---\r\n# a map\r\nimage: 'my map.pgm'  # quoted\r\nresolution: 5e-2\r\n"
                     "origin:\r\n- 1\r\n- -2.5\r\n- 0\r\n\r\nnegate: true\r\nmode: scale\r\n"
                     "occupied_thresh: 0.6\r\nfree_thresh: .2\r\nother: [1, 2]\r\n",
                     "map.yaml");
  EXPECT_EQ(x.image, "my map.pgm");
  EXPECT_EQ(x.resolution, 0.05);
  EXPECT_EQ(x.origin, (Pose2{1, -2.5, 0}));
  EXPECT_TRUE(x.negate);
  EXPECT_EQ(x.mode, MapMode::scale);
  EXPECT_EQ(x.free_threshold, 0.2);
}

TEST(MapServer, NamesTheLineAndTheRemedy) {
  EXPECT_EQ(problem_of(good), "no problem");
  for (auto* value : {"0", "-0.05", "nan", "inf", "five"}) {
    auto problem = problem_of(with("resolution", std::string{"resolution: "} + value));
    EXPECT_THAT(problem, HasSubstr("map.yaml:2: error")) << value;
    EXPECT_THAT(problem, HasSubstr("resolution: 0.05")) << value;
  }
  EXPECT_THAT(
    problem_of(with("occupied_thresh", "occupied_thresh: 0.1")),
    HasSubstr("map.yaml:5: error: occupied_thresh (0.1) is not above free_thresh (0.196)"));
  EXPECT_THAT(problem_of(with("free_thresh", "free_thresh: 2")),
              HasSubstr("map.yaml:6: error: 2 is not a probability"));
  EXPECT_THAT(problem_of(with("origin", "origin: [1, 2]")),
              HasSubstr("map.yaml:3: error: 'origin' is not a list of three finite numbers"));
  EXPECT_THAT(problem_of(with("origin", "origin: [1, 2, nan]")), HasSubstr("map.yaml:3: error"));
  EXPECT_THAT(problem_of(with("negate", "negate: maybe")),
              HasSubstr("map.yaml:4: error: 'maybe' is neither 0 nor 1"));
  EXPECT_THAT(problem_of(std::string{good} + "mode: colourful\n"),
              HasSubstr("map.yaml:7: error: 'colourful' is not a mode"));
  EXPECT_THAT(problem_of(std::string{good} + "image: b.pgm\n"),
              HasSubstr("map.yaml:7: error: the key 'image' is there twice, first in line 1"));
  EXPECT_THAT(problem_of("image\n"), HasSubstr("map.yaml:1: error: this line is no 'key: value'"));
  EXPECT_THAT(problem_of(with("origin", "origin: [1, 2, 3")),
              HasSubstr("map.yaml:3: error: the list does not end in this line"));
}

TEST(MapServer, SaysWhichKeysAreMissing) {
  for (auto* key : {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) {
    auto problem = problem_of(with(key, ""));
    EXPECT_THAT(problem,
                HasSubstr(std::string{"map.yaml: error: the key '"} + key + "' is missing"));
  }
  // All problems at once.
  auto all = problem_of("mode: trinary\n");
  EXPECT_THAT(all, HasSubstr("'image' is missing"));
  EXPECT_THAT(all, HasSubstr("'free_thresh' is missing"));
}

TEST(MapServer, SaysWhichFileIsMissingOrDamaged) {
  TemporaryFolder folder;
  auto problem = [&](const std::string& name) -> std::string {
    try {
      read_map_server(folder / name);
    } catch (const MapFileError& e) {
      return e.what();
    }
    return "no problem";
  };
  EXPECT_THAT(problem("none.yaml"), HasSubstr("none.yaml: error: there is no such file"));
  write(folder / "map.yaml", good);
  EXPECT_THAT(problem("map.yaml"),
              HasSubstr("map.yaml:1: error: the image " + (folder / "map.pgm").string() +
                        ": there is no such file"));
  write(folder / "map.pgm", "this is no image");
  EXPECT_THAT(problem("map.yaml"), HasSubstr("it is no image, or is damaged"));
  // Half of its pixels are missing.
  write(folder / "map.pgm", "P5\n4 4\n255\n12345678");
  EXPECT_THAT(problem("map.yaml"), HasSubstr("it is no image, or is damaged"));
}

TEST(MapServer, ModesAndNegationAreThoseOfRos) {
  const std::vector<int> greys{0, 80, 100, 205, 206, 254, 255};
  EXPECT_EQ(cells_of(good, greys), (std::vector<int>{100, 100, -1, -1, 0, 0, 0}));
  EXPECT_EQ(cells_of(with("negate", "negate: 1"), greys),
            (std::vector<int>{0, -1, -1, 100, 100, 100, 100}));
  // (155/255 - 0.196) / (0.65 - 0.196) = 0.907
  EXPECT_EQ(cells_of(std::string{good} + "mode: scale\n", {0, 100, 205, 255}),
            (std::vector<int>{100, 91, 0, 0}));
  EXPECT_EQ(cells_of(std::string{good} + "mode: raw\n", {0, 50, 100, 101, 255}),
            (std::vector<int>{0, 50, 100, -1, -1}));
}

TEST(MapServer, TransparentPixelsAreUnknownInTheModeScale) {
  TemporaryFolder folder;
  write(folder / "map.yaml", with("image", "image: map.png") + "mode: scale\n");
  cv::Mat image(1, 2, CV_8UC4, cv::Scalar{0, 0, 0, 255});
  image.at<cv::Vec4b>(0, 1)[3] = 0;
  cv::imwrite((folder / "map.png").string(), image);
  auto map = read_map_server(folder / "map.yaml");
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{100, -1}));
}

TEST(MapServer, TheFirstRowOfTheImageIsTheUpperOne) {
  TemporaryFolder folder;
  write(folder / "map.yaml", good);
  std::string image = "P5\n2 2\n255\n";
  for (auto x : {0, 254, 254, 205})
    image.push_back(static_cast<char>(x));
  write(folder / "map.pgm", image);
  auto map = read_map_server(folder / "map.yaml");
  EXPECT_EQ(map.at(0, 1), 100);
  EXPECT_EQ(map.at(1, 0), -1);
  EXPECT_EQ(map.origin, (Pose2{-1.5, 2, 0.25}));
  EXPECT_EQ(map.cell_size, 0.1);
}

RC_GTEST_PROP(MapServer, ReadsWhatItWrites, ()) {
  CellMap map;
  map.columns = *rc::gen::inRange(1, 20);
  map.rows = *rc::gen::inRange(1, 20);
  map.cell_size = *rc::gen::inRange(1, 200) / 1000.;
  map.origin = {*rc::gen::inRange(-90000, 90000) / 1000., *rc::gen::inRange(-90000, 90000) / 1000.,
                *rc::gen::inRange(-3000, 3000) / 1000.};
  for (int i = 0; i < map.columns * map.rows; ++i)
    map.cells.push_back(*rc::gen::element<std::int8_t>(-1, 0, 100));
  TemporaryFolder folder;
  write_map_server(map, folder / "map");
  RC_ASSERT(read_map_server(folder / "map.yaml") == map);
}

TEST(MapServer, WhatCannotBeWrittenIsSaid) {
  TemporaryFolder folder;
  CellMap map{1, 1, 0.05, {}, {0}};
  EXPECT_THROW(write_map_server(map, folder / "no_such_folder" / "map"), MapFileError);
  EXPECT_THROW(write_map_server({}, folder / "map"), MapFileError);
}

TEST(MapServer, ReadsMapsOfOthers) {
  const std::filesystem::path maps = CASTOR_MAPS;
  if (!exists(maps / "nav2_depot.yaml"))
    GTEST_SKIP() << "needs the maps in " << maps;
  auto depot = read_map_server(maps / "nav2_depot.yaml");
  EXPECT_EQ(depot.columns, 604);
  EXPECT_EQ(depot.rows, 307);
  EXPECT_GT(std::ranges::count(depot.cells, 100), 1000);
  auto house = read_map_server(maps / "aws_small_house.yaml");
  EXPECT_EQ(house.columns, 500);
  EXPECT_EQ(house.origin, (Pose2{-12.5, -12.5, 0}));
  EXPECT_GT(std::ranges::count(house.cells, 0), 10000);
  // Written by this program, and read again.
  TemporaryFolder folder;
  write_map_server(house, folder / "house");
  EXPECT_EQ(read_map_server(folder / "house.yaml"), house);
}

} // namespace

} // namespace castor::mapping::test
