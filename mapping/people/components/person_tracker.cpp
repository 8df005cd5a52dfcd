#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/people/person_detector.hpp"
#include "castor/mapping/people/person_tracks.hpp"
#include "castor/mapping/people/types.hpp"
#include "castor/mapping/planar/corrected_pose.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Watches the people around the robot: a Person entry each.
class PersonTracker final : public UnmanagedComponent {
  void configure() override {
    DetectorOptions detection;
    detection.range = range_;
    detector_ = std::make_unique<PersonDetector>(detection);
  }

  void start() override {
    TrackOptions tracking;
    tracking.patience = std::chrono::duration<double>(patience_.get()).count();
    tracks_ = std::make_unique<PersonTracks>(tracking, remove_former() + 1);
    on_push<Odometry>(robot_, [this](auto& x) { corrected_.add(*x); });
    on_push<LaserScan>(robot_, [this](auto& x) { look(*x); });
    on_change(changed<RobotPose>().in(localisation_),
              [this](const ChangeEvent& event) { localise(event.address); });
    // It is not told again while the robot stands.
    for (auto& x : read_all_in<RobotPose>(localisation_.get()))
      take_pose(*x);
  }

  /// A tracker before this one has failed: whom it knew is not known any more. Returns the greatest
  /// of their ids.
  std::int64_t remove_former() {
    std::int64_t greatest = 0;
    for (const auto& x : read_all<Person>()) {
      greatest = std::max(greatest, x->id);
      delete_entry(x.address);
    }
    return greatest;
  }

  void localise(const Address& address) {
    try {
      take_pose(*read<RobotPose>(address));
    } catch (const DoesNotExistOnWM&) {
      // The next pose comes with another event.
    }
  }

  void take_pose(const RobotPose& x) {
    if (x.state != LocalisationState::starting && x.state != LocalisationState::lost)
      corrected_.correct(x.time, x.pose);
  }

  void look(const LaserScan& scan) {
    const auto newest = corrected_.odometry().newest();
    if (!newest)
      return;
    const auto robot = corrected_.odometry().pose_at(scan.time).value_or(newest->pose);
    const auto parts = detector_->detect(scan, robot, tracks_->expected(scan.time));
    tracks_->add(parts, ScanView{scan, robot}, scan.time);
    if (corrected_.odometry_frame() && now() - told_ >= period_.get())
      tell(scan.time);
  }

  void tell(std::int64_t time) {
    told_ = now();
    std::set<std::int64_t> present;
    for (const auto& track : tracks_->people()) {
      const auto in_map =
        compose(*corrected_.odometry_frame(), {track.place.x, track.place.y, track.heading});
      put(here(id_of(track.id)), Person{track.id, time, in_map.x, in_map.y, in_map.heading,
                                        track.speed(), track.visibility});
      present.insert(track.id);
    }
    for (const auto id : told_of_)
      if (!present.contains(id))
        delete_entry(here(id_of(id)));
    told_of_ = std::move(present);
  }

  static std::string id_of(std::int64_t id) { return "person-" + std::to_string(id); }

  Option<StandaloneName> robot_{this, "robot", "robot", "who pushes LaserScan and Odometry"};
  Option<SubarchitectureName> localisation_{this, "localisation", "slam",
                                            "whose RobotPose entries say where the robot is"};
  Option<double> range_{this, "range", 8, "how far from the laser people are looked for, metres"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 3000ms,
                                              "how long somebody out of sight is still expected"};
  Option<std::chrono::milliseconds> period_{this, "period", 200ms,
                                            "time between overwrites of the entries"};

  std::unique_ptr<PersonDetector> detector_;
  std::unique_ptr<PersonTracks> tracks_;
  CorrectedPose corrected_;
  Timestamp told_{0};
  /// Ids of whom there are entries.
  std::set<std::int64_t> told_of_;
};

CASTOR_COMPONENT(PersonTracker, "watches the people around a robot, by its laser")

} // namespace

} // namespace castor::mapping
