#include "castor/perception/vision/segmentation/grouping.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "castor/perception/vision/segmentation/surface.hpp"

namespace castor::vision {

namespace {

constexpr int none = -1;
constexpr double never = std::numeric_limits<double>::infinity();

/// The part that `id` has the longest boundary with; `none` if it touches the ground only.
int main_neighbour(const AreaGraph& graph, int id) {
  int best = none;
  int length = 0;
  for (const auto& contact : graph.area(id).contacts) {
    if (contact.area != graph.ground() && contact.length > length) {
      best = contact.area;
      length = contact.length;
    }
  }
  return best;
}

void join_crumbs(AreaGraph& graph, const SegmentationOptions& options) {
  std::vector<int> crumbs;
  for (int id = 0; id < graph.count(); ++id) {
    if (graph.is_part(id) && graph.area(id).pixels() < options.crumb_pixels)
      crumbs.push_back(id);
  }
  std::sort(crumbs.begin(), crumbs.end(), [&](int a, int b) {
    return std::pair(graph.area(a).cells.size(), a) < std::pair(graph.area(b).cells.size(), b);
  });
  for (const int crumb : crumbs) {
    if (!graph.is_part(crumb) || graph.area(crumb).pixels() >= options.crumb_pixels)
      continue;
    int best = none;
    double least = never;
    for (const auto& contact : graph.area(crumb).contacts) {
      const double difference = contact.area == graph.ground()
                                  ? ground_difference(graph.area(crumb))
                                  : lab_difference(graph.area(crumb), graph.area(contact.area));
      if (difference < least) {
        least = difference;
        best = contact.area;
      }
    }
    if (best != none)
      graph.join(crumb, best);
  }
}

void join_ground_like(AreaGraph& graph, const SegmentationOptions& options) {
  for (int id = 0; id < graph.count(); ++id) {
    if (graph.is_part(id) && ground_difference(graph.area(id)) < options.ground_difference &&
        graph.contact(id, graph.ground()) != nullptr)
      graph.join(graph.ground(), id);
  }
}

/// What it costs to take two areas for one object; remembered, for most pairs are asked for often.
class PairCosts {
public:
  PairCosts(AreaGraph& graph, const SegmentationOptions& options)
    : graph_(graph), options_(options) {
    // nop
  }

  /// `never`, or degrees of colour difference.
  double operator()(const Contact& contact, int id) {
    const auto key = std::minmax(id, contact.area);
    const auto known = costs_.find(key);
    if (known != costs_.end())
      return known->second;
    const double cost = compute(contact, id);
    costs_.emplace(key, cost);
    return cost;
  }

  void forget(int a, int b) {
    std::erase_if(costs_, [a, b](const auto& entry) {
      const auto& [first, second] = entry.first;
      return first == a || second == a || first == b || second == b;
    });
  }

private:
  double compute(const Contact& contact, int id) {
    const Area& a = graph_.area(id);
    const Area& b = graph_.area(contact.area);
    const Surface surface_a = surface_of(a);
    const Surface surface_b = surface_of(b);
    const auto shade_and_colour = [this](const Surface& one, const Surface& other) {
      return one.angle < options_.shade_angle && other.angle > options_.colour_angle;
    };
    if (shade_and_colour(surface_a, surface_b) || shade_and_colour(surface_b, surface_a))
      return never;
    const double difference = surface_difference(surface_a, surface_b, options_.saturation_weight);
    const bool same_surface = difference <= options_.surface_angle;
    const bool inner = is_inner(contact, id);
    if (!same_surface && !inner)
      return never;
    const HullRest rest = graph_.hull_rest(id, contact.area);
    const double open = rest.ground + rest.others;
    if (!(same_surface && rest.ground <= options_.concavity) &&
        !(inner && open <= options_.completion))
      return never;
    return difference + options_.contrast_weight * contact.mean_contrast() +
           options_.hull_weight * 100 * open;
  }

  /// Whether the boundary is weaker than both areas' boundaries with the ground.
  bool is_inner(const Contact& contact, int id) const {
    const Contact* outline = graph_.contact(id, graph_.ground());
    const Contact* other_outline = graph_.contact(contact.area, graph_.ground());
    return outline != nullptr && other_outline != nullptr &&
           contact.mean_contrast() <=
             options_.inner_contrast *
               std::min(outline->mean_contrast(), other_outline->mean_contrast());
  }

  AreaGraph& graph_;
  const SegmentationOptions& options_;
  std::map<std::pair<int, int>, double> costs_;
};

void join_surfaces(AreaGraph& graph, const SegmentationOptions& options) {
  PairCosts costs(graph, options);
  for (;;) {
    double least = never;
    std::pair<int, int> best;
    for (int id = 0; id < graph.count(); ++id) {
      if (!graph.is_part(id))
        continue;
      for (const auto& contact : graph.area(id).contacts) {
        if (contact.area <= id || contact.area == graph.ground())
          continue;
        const double cost = costs(contact, id);
        if (cost < least) {
          least = cost;
          best = {id, contact.area};
        }
      }
    }
    if (least == never)
      return;
    graph.join(best.first, best.second);
    costs.forget(best.first, best.second);
  }
}

/// Whether the colour alone tells: on a coloured ground, few things have the very colour of what
/// they are on, only darker, and lie at another thing that has not.
bool has_shadow_colour(const AreaGraph& graph, int id, const SegmentationOptions& options) {
  const Area& area = graph.area(id);
  const Surface surface = surface_of(area);
  const bool grey = ground_colourfulness(area) < options.grey_angle;
  if (surface.angle > (grey ? options.grey_shadow_angle : options.shadow_angle) ||
      surface.brightness > options.shadow_depth || surface.brightness < options.shadow_brightness)
    return false;
  if (grey && shade_range(area, graph.shade()) > options.shadow_range)
    return false;
  int touched = 0;
  for (const auto& contact : area.contacts) {
    if (contact.area == graph.ground())
      continue;
    const double angle = surface_of(graph.area(contact.area)).angle;
    if (angle > options.caster_angle + 1.5 * surface.angle)
      touched += contact.length;
  }
  const Contact* outline = graph.contact(id, graph.ground());
  return touched >= options.shadow_contact * area.boundary() && outline != nullptr &&
         outline->length >=
           (grey ? options.grey_shadow_open : options.shadow_open) * area.boundary();
}

bool is_shadow(const AreaGraph& graph, int id, const SegmentationOptions& options) {
  const Area& area = graph.area(id);
  const Contact* outline = graph.contact(id, graph.ground());
  const int caster_id = main_neighbour(graph, id);
  if (outline == nullptr || caster_id == none)
    return false;
  const Surface surface = surface_of(area);
  if (surface.angle > options.shade_angle || surface.brightness > 1 ||
      surface.brightness < options.shadow_brightness)
    return false;
  const Contact& contact = *graph.contact(id, caster_id);
  const Area& caster = graph.area(caster_id);
  const double softness = outline->mean_contrast() / contact.mean_contrast();
  const bool caster_is_coloured = surface_of(caster).angle > options.colour_angle;
  if (softness >= (caster_is_coloured ? 1.0 : options.shadow_softness) ||
      area.pixels() >= options.shadow_area * caster.pixels())
    return false;
  const Extent extent = extent_of(area, graph.labels().width());
  const Extent caster_extent = extent_of(caster, graph.labels().width());
  const int height = caster_extent.bottom - caster_extent.top + 1;
  return extent.bottom > caster_extent.top + options.shadow_foot * height &&
         compactness(area, graph.labels().width()) < options.shadow_compactness;
}

template <class Predicate>
void join_shadows(AreaGraph& graph, Predicate is_one) {
  bool found = true;
  while (found) {
    found = false;
    for (int id = 0; id < graph.count(); ++id) {
      if (graph.is_part(id) && is_one(id)) {
        graph.join(graph.ground(), id);
        found = true;
      }
    }
  }
}

/// Whether `id` is a piece of its main neighbour; small ones are, if that is most of what they
/// touch.
bool is_inset(AreaGraph& graph, int id, const SegmentationOptions& options) {
  const int host = main_neighbour(graph, id);
  if (host == none || graph.area(id).pixels() >= graph.area(host).pixels())
    return false;
  const Area& area = graph.area(id);
  const double boundary = area.boundary();
  const double shared = graph.contact(id, host)->length / boundary;
  const Contact* outline = graph.contact(id, graph.ground());
  const double open = outline == nullptr ? 0 : outline->length / boundary;
  // Most of the boundary must be with the host.
  if (shared <= 0.5)
    return false;
  if (area.pixels() < options.piece_area * graph.labels().size())
    return true;
  return open < options.inset_ground &&
         area.pixels() < options.inset_area * graph.area(host).pixels() &&
         graph.hull_rest(id, host).ground <= 2 * options.concavity;
}

/// Likewise where there is no ground: then the border and third areas count as the ground does.
bool is_enclosed(const AreaGraph& graph, int id, const SegmentationOptions& options) {
  const int host = main_neighbour(graph, id);
  if (host == none)
    return false;
  const Area& area = graph.area(id);
  const double boundary = area.boundary() + area.border;
  return graph.contact(id, host)->length > (1 - options.inset_ground) * boundary &&
         area.pixels() < options.inset_area * graph.area(host).pixels();
}

/// Joins the areas that `belongs` is true of to their main neighbours, the smallest first.
template <class Predicate>
void join_to_neighbours(AreaGraph& graph, Predicate belongs) {
  for (;;) {
    int smallest = none;
    for (int id = 0; id < graph.count(); ++id) {
      if (graph.is_part(id) &&
          (smallest == none || graph.area(id).cells.size() < graph.area(smallest).cells.size()) &&
          belongs(id))
        smallest = id;
    }
    if (smallest == none)
      return;
    graph.join(smallest, main_neighbour(graph, smallest));
  }
}

void join_insets(AreaGraph& graph, const SegmentationOptions& options) {
  join_to_neighbours(graph, [&](int id) { return is_inset(graph, id, options); });
}

/// Whether two areas are of different colours, whatever their lightness, which textures vary most.
bool differ_in_hue(const Area& a, const Area& b, const SegmentationOptions& options) {
  return std::min(a.pixels(), b.pixels()) >= options.hue_pixels &&
         chroma_difference(a, b) > options.hue_difference;
}

} // namespace

void join_weak(AreaGraph& graph, double max_contrast, double clear_contrast,
               const SegmentationOptions& options) {
  struct Candidate {
    double contrast;
    int a;
    int b;
    int length;

    bool operator<(const Candidate& other) const {
      return std::tie(contrast, a, b) > std::tie(other.contrast, other.a, other.b);
    }
  };
  std::priority_queue<Candidate> candidates;
  const auto push = [&](int id, const Contact& contact) {
    if (contact.mean_contrast() <= max_contrast)
      candidates.push({contact.mean_contrast(), id, contact.area, contact.length});
  };
  for (int id = 0; id < graph.count(); ++id) {
    for (const auto& contact : graph.area(id).contacts) {
      if (id < contact.area)
        push(id, contact);
    }
  }
  while (!candidates.empty()) {
    const Candidate next = candidates.top();
    candidates.pop();
    if (!graph.exists(next.a) || !graph.exists(next.b))
      continue;
    const Contact* contact = graph.contact(next.a, next.b);
    if (contact == nullptr || contact->length != next.length)
      continue; // The boundary has grown since; it is in the queue again as it is now.
    if (next.contrast > clear_contrast &&
        differ_in_hue(graph.area(next.a), graph.area(next.b), options))
      continue;
    const int survivor = graph.join(next.a, next.b);
    for (const auto& changed : graph.area(survivor).contacts)
      push(survivor, changed);
  }
}

int widest_on_border(const AreaGraph& graph) {
  int widest = 0;
  for (int id = 0; id < graph.count(); ++id) {
    if (graph.area(id).border > graph.area(widest).border)
      widest = id;
  }
  return widest;
}

/// Whether a large area is a thing that the ground goes around, or is seen through, and no sheet
/// with things on it.
bool is_large_thing(const AreaGraph& graph, int id, int ground,
                    const SegmentationOptions& options) {
  const Area& area = graph.area(id);
  if (area.border > 0)
    return false;
  int open = 0;
  for (const auto& contact : area.contacts) {
    if (contact.area == ground ||
        lab_difference(graph.area(contact.area), graph.area(ground)) < options.ground_difference)
      open += contact.length;
  }
  return open >= options.large_alone * area.boundary();
}

void join_ground(AreaGraph& graph, const SegmentationOptions& options) {
  const int ground = widest_on_border(graph);
  const double border = 2.0 * (graph.labels().width() + graph.labels().height());
  const double size = graph.labels().size();
  graph.set_ground(ground);
  for (int id = 0; id < graph.count(); ++id) {
    const bool wide = graph.area(id).border > options.ground_border * border;
    const bool large = graph.area(id).pixels() > options.ground_area * size &&
                       !is_large_thing(graph, id, ground, options);
    if (graph.is_part(id) && (wide || large))
      graph.join(ground, id);
  }
}

void join_ground(AreaGraph& graph, const Grid<std::uint8_t>& foreground) {
  int ground = none;
  for (int id = 0; id < graph.count(); ++id) {
    if (!graph.exists(id) || id == ground)
      continue;
    double on = 0;
    for (const int cell : graph.area(id).cells)
      on += foreground[cell] != 0 ? 1 : 0;
    if (on >= 0.5 * graph.area(id).pixels())
      continue;
    ground = ground == none ? id : graph.join(ground, id);
    graph.set_ground(ground);
  }
}

void group(AreaGraph& graph, const SegmentationOptions& options) {
  join_crumbs(graph, options);
  join_ground_like(graph, options);
  // Before they are joined to what casts them.
  join_shadows(graph, [&](int id) { return has_shadow_colour(graph, id, options); });
  join_surfaces(graph, options);
  join_shadows(graph, [&](int id) {
    return has_shadow_colour(graph, id, options) || is_shadow(graph, id, options);
  });
  join_insets(graph, options);
  join_surfaces(graph, options);
}

void group_without_ground(AreaGraph& graph, const SegmentationOptions& options) {
  join_crumbs(graph, options);
  join_to_neighbours(graph, [&](int id) { return is_enclosed(graph, id, options); });
}

} // namespace castor::vision
