#include "castor/benchmarks/slam/slam_settings.hpp"

#include <utility>

namespace castor::slam_benchmark {

double* setting(mapping::SlamOptions& x, std::string_view name) {
  auto& front = x.front_end;
  auto& loops = x.loop_closer;
  const std::pair<std::string_view, double*> settings[]{
    {"keyframe_distance", &front.keyframe_distance},
    {"keyframe_turn", &front.keyframe_turn},
    {"odometry_translation", &front.odometry_translation},
    {"late_odometry", &front.late_odometry},
    {"late_odometry_heading", &front.late_odometry_heading},
    {"moved_behind", &front.map.moved.behind},
    {"most_moved", &front.most_moved},
    {"believed_deviations", &front.believed_deviations},
    {"few_points", &front.few_points},
    {"most_deviations", &front.most_deviations},
    {"search_gain", &front.search_gain},
    {"sure_matched", &front.sure_matched},
    {"spacing", &front.spacing},
    {"noise_of_points", &front.matcher.noise},
    {"last_distance", &front.matcher.last_distance},
    {"robust_points", &front.matcher.robust_from},
    {"fit_radius", &front.surface.fit_radius},
    {"max_range", &front.surface.max_range},
    {"motion_deviation", &front.motion_deviation},
    {"motion_deviation_heading", &front.motion_deviation_heading},
    {"loop_moved_behind", &loops.moved.behind},
    {"loop_spacing", &loops.spacing},
    {"loop_last_distance", &loops.matcher.last_distance},
    {"loop_robust_points", &loops.matcher.robust_from},
    {"loop_fit_radius", &loops.surface.fit_radius},
    {"least_path", &loops.least_path},
    {"near", &loops.near},
    {"window", &loops.window},
    {"drift_window", &loops.drift},
    {"search_distance", &loops.search_distance},
    {"search_turn", &loops.search_turn},
    {"least_score", &loops.least_score},
    {"least_matched", &loops.least_matched},
    {"least_observability", &loops.least_observability},
    {"most_deviation", &loops.most_deviation},
    {"deviation", &loops.deviation},
    {"most_window", &loops.most_window},
    {"sure_window", &loops.sure_window},
    {"confirmation", &loops.confirmation},
    {"agreement", &loops.agreement},
    {"patience", &loops.patience},
    {"deviation_heading", &loops.deviation_heading},
    {"robust_loops", &x.graph.graph.robust_from},
    {"odometry_rest", &front.odometry_rest},
    {"odometry_rest_heading", &front.odometry_rest_heading},
    {"odometry_turn", &front.odometry_turn},
    {"odometry_drift", &front.odometry_drift},
  };
  for (auto& [known, value] : settings)
    if (known == name)
      return value;
  return nullptr;
}

} // namespace castor::slam_benchmark
