#include "castor/mapping/logs/rawlog.hpp"

#include "castor/base/input_file.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace castor::mapping {

namespace {

using mrpt::obs::CObservation;

/// Between scans without time stamps, microseconds.
constexpr std::int64_t assumed_period = 100'000;
/// A scanner that is tilted by more does not see the floor plan.
const double most_tilt = 5 * std::numbers::pi / 180;

Pose2 pose2(const mrpt::poses::CPose2D& x) {
  return {x.x(), x.y(), normalised(x.phi())};
}

Pose2 pose2(const mrpt::poses::CPose3D& x) {
  return {x.x(), x.y(), normalised(x.yaw())};
}

geometry::Point3 on_robot(const mrpt::poses::CPose3D& sensor, double x, double y, double z) {
  geometry::Point3 result;
  sensor.composePoint(x, y, z, result.x, result.y, result.z);
  return result;
}

std::string class_name(const mrpt::rtti::CObject& x) {
  std::string result = x.GetRuntimeClass()->className;
  // Newer files have names with a namespace.
  if (auto at = result.rfind("::"); at != std::string::npos)
    result.erase(0, at + 2);
  return result;
}

/// Gathers what the objects of a file say.
class RawlogReader {
public:
  RawlogReader(std::string file, RawlogOptions options)
    : file_(std::move(file)), options_(std::move(options)) {}

  void take(const mrpt::serialization::CSerializable& object) {
    if (auto* frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object)) {
      for (auto& x : *frame)
        take_observation(*x);
    } else if (auto* actions = dynamic_cast<const mrpt::obs::CActionCollection*>(&object)) {
      for (auto& x : *actions)
        take_action(*x);
    } else if (auto* observation = dynamic_cast<const CObservation*>(&object)) {
      take_observation(*observation);
    } else if (auto* whole = dynamic_cast<const mrpt::obs::CRawlog*>(&object)) {
      for (auto& x : *whole)
        if (x)
          take(*x);
    } else {
      ++result_.contents[class_name(object)];
    }
  }

  bool is_empty() const { return result_.contents.empty(); }

  void add(Severity severity, std::string message, std::string remedy) {
    Diagnostic x;
    x.severity = severity;
    x.where = SourceLocation{file_, 0};
    x.message = std::move(message);
    x.remedy = std::move(remedy);
    diagnostics_.push_back(std::move(x));
  }

  RawlogResult result() && {
    choose_laser();
    if (tilted_ > 0)
      add(Severity::warning,
          std::to_string(tilted_) + " scans are of a laser that is tilted by more than 5 degrees",
          "They are left out; use the scans of another sensor.");
    if (without_time_ > 0)
      add(Severity::warning, std::to_string(without_time_) + " observations have no time stamp",
          "They are taken as 0.1 s after the one before.");
    if (backward_ > 0)
      add(Severity::warning,
          "time runs backward at " + std::to_string(backward_) + " of the observations",
          "They are sorted by time; record the log again if the map is not right.");
    if (!has_errors(diagnostics_) && result_.log.scans.empty() && result_.clouds.empty())
      add(Severity::error, "the log has no laser scan: it has " + contents_text(),
          "Use a log with CObservation2DRangeScan, or with a rotating laser or a depth camera.");
    if (has_errors(diagnostics_))
      return {std::nullopt, std::move(diagnostics_)};
    auto by_time = [](auto& x) {
      std::ranges::stable_sort(x, {}, [](auto& element) {
        if constexpr (requires { element.scan; })
          return element.scan.time;
        else
          return element.time;
      });
    };
    by_time(result_.log.scans);
    by_time(result_.log.odometry);
    by_time(result_.clouds);
    return {std::move(result_), std::move(diagnostics_)};
  }

private:
  void take_action(const mrpt::obs::CAction& action) {
    ++result_.contents[class_name(action)];
    auto* x = dynamic_cast<const mrpt::obs::CActionRobotMovement2D*>(&action);
    if (!x)
      return;
    auto increment = x->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry
                       ? x->rawOdometryIncrementReading
                       : x->poseChange->getMeanVal();
    odometry_ = compose(odometry_, pose2(increment));
  }

  void take_observation(const CObservation& x) {
    ++result_.contents[x.sensorLabel.empty() ? class_name(x) : class_name(x) + " " + x.sensorLabel];
    // Time is asked only of what is used: stamps of other sensors may be missing.
    if (auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&x))
      take_odometry(*odometry, time_of(x));
    else if (auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&x))
      take_scan(*scan, time_of(x));
    else if (auto* velodyne = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&x))
      take_velodyne(*velodyne, time_of(x));
    else if (auto* rotating = dynamic_cast<const mrpt::obs::CObservationRotatingScan*>(&x))
      take_rotating(*rotating, time_of(x));
    else if (auto* depths = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&x))
      take_depths(*depths, time_of(x));
  }

  std::int64_t time_of(const CObservation& x) {
    if (x.timestamp == INVALID_TIMESTAMP) {
      ++without_time_;
      return time_ += assumed_period;
    }
    auto time = std::llround(mrpt::Clock::toDouble(x.timestamp) * 1e6);
    if (!has_time_)
      shift(time - assumed_period - time_);
    has_time_ = true;
    if (time < time_)
      ++backward_;
    return time_ = time;
  }

  /// Observations before the first time stamp were just before it, not in 1970.
  void shift(std::int64_t by) {
    time_ += by;
    for (auto& x : result_.log.odometry)
      x.time += by;
    for (auto& [label, scans] : scans_)
      for (auto& x : scans) {
        x.scan.time += by;
        x.odometry.time += by;
        x.logged_time += by;
      }
    for (auto& x : result_.clouds)
      x.time += by;
  }

  void take_odometry(const mrpt::obs::CObservationOdometry& x, std::int64_t time) {
    odometry_ = pose2(x.odometry);
    Odometry odometry{time, odometry_, {}};
    if (x.hasVelocities)
      odometry.velocity = {x.velocityLocal.vx, x.velocityLocal.omega};
    result_.log.odometry.push_back(odometry);
  }

  void take_scan(const mrpt::obs::CObservation2DRangeScan& x, std::int64_t time) {
    // The z axis of the sensor in the robot's frame: up, down or tilted.
    auto up = x.sensorPose.getRotationMatrix()(2, 2);
    if (std::abs(up) < std::cos(most_tilt)) {
      ++tilted_;
      return;
    }
    LoggedScan result;
    result.scan.time = time;
    result.scan.mount = pose2(x.sensorPose);
    result.scan.max_range = static_cast<double>(x.maxRange);
    auto beams = x.getScanSize();
    result.scan.angle_step =
      beams > 1 ? static_cast<double>(x.aperture) / static_cast<double>(beams - 1) : 0;
    result.scan.first_angle = -static_cast<double>(x.aperture) / 2;
    for (std::size_t i = 0; i < beams; ++i) {
      auto range = x.getScanRange(i);
      auto good =
        x.getScanRangeValidity(i) && std::isfinite(range) && range > 0 && range < x.maxRange;
      result.scan.ranges.push_back(good ? range : 0);
    }
    // The beams are symmetric about the middle, so turning the scan over reverses them.
    if (x.rightToLeft != (up > 0))
      std::ranges::reverse(result.scan.ranges);
    result.odometry = {time, odometry_, {}};
    result.logged_time = time;
    scans_[x.sensorLabel].push_back(std::move(result));
  }

  void take_velodyne(const mrpt::obs::CObservationVelodyneScan& x, std::int64_t time) {
    auto scan = x;
    if (scan.point_cloud.x.empty())
      scan.generatePointCloud();
    LoggedCloud cloud = new_cloud(x.sensorPose, time);
    for (std::size_t i = 0; i < scan.point_cloud.x.size(); ++i)
      cloud.points.push_back(on_robot(x.sensorPose, static_cast<double>(scan.point_cloud.x[i]),
                                      static_cast<double>(scan.point_cloud.y[i]),
                                      static_cast<double>(scan.point_cloud.z[i])));
    result_.clouds.push_back(std::move(cloud));
  }

  /// A rotating scan says no elevations: only those of one ring, which is planar, are known.
  void take_rotating(const mrpt::obs::CObservationRotatingScan& x, std::int64_t time) {
    if (x.rowCount != 1 || x.columnCount < 2)
      return;
    mrpt::obs::CObservation2DRangeScan planar;
    planar.sensorLabel = x.sensorLabel;
    planar.sensorPose = x.sensorPose;
    planar.maxRange = static_cast<float>(x.maxRange);
    planar.aperture = static_cast<float>(std::abs(x.azimuthSpan));
    planar.rightToLeft = x.azimuthSpan > 0;
    planar.resizeScan(x.columnCount);
    for (int i = 0; i < x.columnCount; ++i) {
      auto range = static_cast<float>(x.rangeImage(0, i) * x.rangeResolution);
      planar.setScanRange(static_cast<std::size_t>(i), range);
      planar.setScanRangeValidity(static_cast<std::size_t>(i), range > 0);
    }
    take_scan(planar, time);
    // Its middle is where the rotation has it, and not the x axis of the sensor.
    auto& scan = scans_[x.sensorLabel];
    if (!scan.empty())
      scan.back().scan.first_angle = std::min(x.startAzimuth, x.startAzimuth + x.azimuthSpan);
  }

  void take_depths(const mrpt::obs::CObservation3DRangeScan& x, std::int64_t time) {
    auto scan = x;
    if (scan.hasRangeImage && !scan.hasPoints3D)
      scan.unprojectInto(scan);
    if (!scan.hasPoints3D)
      return;
    LoggedCloud cloud = new_cloud(x.sensorPose, time);
    for (std::size_t i = 0; i < scan.points3D_x.size(); ++i)
      // 0 forward is a pixel without depth.
      if (scan.points3D_x[i] > 0)
        cloud.points.push_back(on_robot(x.sensorPose, static_cast<double>(scan.points3D_x[i]),
                                        static_cast<double>(scan.points3D_y[i]),
                                        static_cast<double>(scan.points3D_z[i])));
    result_.clouds.push_back(std::move(cloud));
  }

  LoggedCloud new_cloud(const mrpt::poses::CPose3D& sensor, std::int64_t time) const {
    LoggedCloud result;
    result.time = time;
    result.sensor = {sensor.x(), sensor.y(), sensor.z()};
    result.odometry = odometry_;
    return result;
  }

  void choose_laser() {
    std::string labels;
    for (auto& [label, scans] : scans_)
      labels += (labels.empty() ? "'" : ", '") + label + "' (" + std::to_string(scans.size()) + ")";
    if (!options_.laser.empty() && !scans_.contains(options_.laser)) {
      add(Severity::error, "the log has no scans of the sensor '" + options_.laser + "'",
          scans_.empty() ? "It has no planar scans at all." : "Its lasers are " + labels + ".");
      return;
    }
    if (scans_.empty())
      return;
    auto chosen = options_.laser.empty()
                    ? std::ranges::max_element(scans_, {}, [](auto& x) { return x.second.size(); })
                    : scans_.find(options_.laser);
    if (scans_.size() > 1)
      add(Severity::note,
          "the log has several lasers: " + labels + "; the scans are those of '" + chosen->first +
            "'",
          "Name another one to use its scans.");
    result_.log.scans = std::move(chosen->second);
  }

  std::string contents_text() const {
    std::string result;
    for (auto& [name, count] : result_.contents)
      result += (result.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    return result;
  }

  std::string file_;
  RawlogOptions options_;
  Rawlog result_;
  std::vector<Diagnostic> diagnostics_;
  std::map<std::string, std::vector<LoggedScan>> scans_;
  Pose2 odometry_;
  std::int64_t time_ = 0;
  bool has_time_ = false;
  std::size_t without_time_ = 0;
  std::size_t backward_ = 0;
  std::size_t tilted_ = 0;
};

/// The line of an exception of MRPT that says what is wrong, without where in MRPT it is.
std::string reason_of(const std::exception& e) {
  std::string text = e.what();
  const std::string mark = "Message:";
  if (auto at = text.find(mark); at != std::string::npos)
    text = text.substr(at + mark.size());
  text = text.substr(0, text.find('\n'));
  text.erase(0, text.find_first_not_of(' '));
  return text;
}

void read_objects(const std::filesystem::path& file, RawlogReader& reader) {
  const char* remedy = "The file is damaged, cut off, or no rawlog: fetch it again.";
  mrpt::io::CFileGZInputStream stream;
  if (!stream.open(file.string())) {
    reader.add(Severity::error, "the file cannot be opened", "Check that you may read it.");
    return;
  }
  auto archive = mrpt::serialization::archiveFrom(stream);
  while (true) {
    auto begin = stream.getPosition();
    try {
      if (auto object = archive.ReadObject())
        reader.take(*object);
    } catch (const mrpt::serialization::CExceptionEOF&) {
      if (stream.getPosition() != begin)
        reader.add(Severity::error,
                   "the file ends in the object that begins at byte " + std::to_string(begin),
                   remedy);
      else if (reader.is_empty())
        reader.add(Severity::error, "the file has no objects", "Use a rawlog that is not empty.");
      return;
    } catch (const std::exception& e) {
      reader.add(Severity::error,
                 "the object at byte " + std::to_string(begin) + " cannot be read: " + reason_of(e),
                 remedy);
      return;
    }
  }
}

} // namespace

RawlogResult read_rawlog(const std::filesystem::path& file, const RawlogOptions& options) {
  // Without it, MRPT takes files with rotating scans for empty ones.
  mrpt::maps::registerAllClasses_mrpt_maps();
  RawlogReader reader{file.string(), options};
  try {
    require_input_file(file);
    read_objects(file, reader);
  } catch (const InputFileError& e) {
    reader.add(Severity::error, e.what(), "Name the file of a rawlog.");
  }
  return std::move(reader).result();
}

} // namespace castor::mapping
