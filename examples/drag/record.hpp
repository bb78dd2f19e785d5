#pragma once
/// \file
/// What the drag program writes as it goes: table, VTK frames, pictures and plots.

#include "parameters.hpp"

#include "scree/io/annotate.hpp"
#include "scree/io/csv.hpp"
#include "scree/io/render.hpp"
#include "scree/io/vtk.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "support/grains_vtk.hpp"
#include "support/plot.hpp"
#include "support/png.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace drag {

inline double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// drag.csv.
class Table {
public:
  explicit Table(const std::filesystem::path& folder)
      : csv_{folder / "drag.csv", columns(),
             "Forces are means since the row before; mass_kg lies in the closed interior of the bucket, "
             "heaped_mass_kg\n"
             "includes the heap above its rim; pitch is positive with the teeth up."} {}
  /// Goes on behind the first `bytes` of a table that was begun.
  Table(const std::filesystem::path& folder, std::uintmax_t bytes)
      : csv_{scree::CsvWriter::go_on(folder / "drag.csv", columns(), bytes)} {}

  [[nodiscard]] std::uintmax_t bytes_on_disk() const { return csv_.bytes_on_disk(); }

  void add(const scree::DragSample& s) {
    csv_.row({s.time, s.drag, s.force, s.force_left, s.force_right, degrees(s.attitude.pitch),
              degrees(s.attitude.roll), degrees(s.attitude.yaw), s.depth, s.fill.struck,
              static_cast<double>(s.bodies), s.kinetic_energy, s.frictional_work, s.fill.heaped});
  }

private:
  static std::vector<std::string> columns() {
    return {"time_s",    "drag_m",           "force_N",           "force_left_N",  "force_right_N",
            "pitch_deg", "roll_deg",         "yaw_deg",           "depth_m",       "mass_kg",
            "particles", "kinetic_energy_J", "frictional_work_J", "heaped_mass_kg"};
  }

  scree::CsvWriter csv_;
};

/// The surface of the bucket where it is now.
template <class Rig>
std::vector<scree::Vector> bucket_in_space(const Rig& rig) {
  std::vector<scree::Vector> vertices;
  for (const scree::Vector& v : rig.bucket().surface.vertices) {
    vertices.push_back(rig.bucket_motion().to_space(v));
  }
  return vertices;
}

/// vtk/: a ParaView series of grains and bucket.
class Frames {
public:
  explicit Frames(const std::filesystem::path& folder)
      : folder_{made(folder / "vtk")}, series_{folder / "drag.pvd"} {}

  template <class Rig>
  void add(const Rig& rig) {
    const auto grains = folder_ / fmt::format("grains_{:04}.vtp", count_);
    const auto bucket = folder_ / fmt::format("bucket_{:04}.vtp", count_);
    scree::examples::write_grains(grains, rig.simulation().bodies());
    scree::write_vtp_surface(bucket, bucket_in_space(rig), rig.bucket().surface.facets);
    series_.add(rig.simulation().time(), grains, 0);
    series_.add(rig.simulation().time(), bucket, 1);
    ++count_;
  }

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.count_, self.series_);
  }

private:
  static std::filesystem::path made(std::filesystem::path folder) {
    std::filesystem::create_directories(folder);
    return folder;
  }

  std::filesystem::path folder_;
  scree::PvdSeries series_;
  int count_ = 0;
};

/// A side view of bed and bucket, cut open along the middle.
template <class Rig>
void draw_view(const std::filesystem::path& file, const Rig& rig, const scree::DragSample& sample) {
  const scree::DragSetup& setup = rig.setup();
  const double above = rig.bucket().interior.vertices.empty() ? 0.2 : 0.3;
  scree::Camera camera;
  camera.target = {0.5 * setup.bed_length, 0.0, 0.5 * (above - setup.bed_depth)};
  camera.width = 1.06 * setup.bed_length;
  constexpr int width = 1600;
  const int height = std::max(420, static_cast<int>(width * (setup.bed_depth + above + 0.12) / camera.width));
  scree::Renderer renderer{width, height, camera};
  renderer.cut({{0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}});
  const auto& bodies = rig.simulation().bodies();
  for (std::size_t s = 0; s < bodies.sphere_count(); ++s) {
    const auto& sphere = bodies.spheres()[s];
    const auto body = static_cast<std::uint32_t>(bodies.id(bodies.body_of(s)));
    renderer.sphere(scree::to_eigen(sphere.position), sphere.radius, scree::rock_colour(body), body);
  }
  renderer.surface(bucket_in_space(rig), rig.bucket().surface.facets, {222, 150, 40}, 1U << 30U);
  renderer.uncut();
  std::vector<scree::Vector> floor;
  for (const auto& point : setup.container().floor) {
    floor.emplace_back(point.x, 0.0, -point.depth);
  }
  floor.insert(floor.begin(), scree::Vector{0.0, 0.0, 0.02});
  floor.emplace_back(setup.bed_length, 0.0, 0.02);
  for (std::size_t k = 1; k < floor.size(); ++k) {
    renderer.line(floor[k - 1], floor[k], {90, 90, 90}, 2.0);
  }
  for (const scree::Rope& rope : rig.ropes()) {
    renderer.line(rig.bucket_motion().to_space(rope.hitch), rope.winch, {60, 60, 70}, 2.0);
  }
  scree::Image image = renderer.image();
  scree::draw_scale_bar(image, renderer.pixels_per_metre());
  scree::draw_text(image, 24, 20,
                   fmt::format("drag {:.2f} m   force {:.0f} N   pitch {:.1f}°   mass {:.1f} kg", sample.drag,
                               sample.force, degrees(sample.attitude.pitch), sample.fill.struck));
  scree::examples::write_png(file, image);
}

/// drag.svg and drag.png: force, pitch, depth and mass with the points that the paper states. Returns a
/// complaint or nothing.
inline std::string draw_plots(const std::filesystem::path& folder, const std::string& title) {
  using scree::examples::Panel;
  const std::string x = "drag distance, m";
  const std::filesystem::path table = "drag.csv";
  // Coetzee et al. (2010) section 7; the curves themselves are in its figures only.
  const std::vector<Panel> panels{
      {"Drag force (both ropes)",
       x,
       "N",
       {{table, "drag_m", "force_N", "scree"}},
       {{0.3, 150.0, "paper, measured and DEM", 0},
        {1.0, 500.0, "paper, measured", 0},
        {1.0, 1500.0, "paper, DEM (almost 3 x)", 1}}},
      {"Pitch (teeth up positive)",
       x,
       "degrees",
       {{table, "drag_m", "pitch_deg", "scree"}},
       {{0.3, -6.5, "paper, measured", 0}, {0.3, -10.0, "paper, DEM", 1}}},
      {"Depth of the centre of gravity", x, "m", {{table, "drag_m", "depth_m", "scree"}}},
      {"Mass in the bucket (full within 1 m, paper)",
       x,
       "kg",
       {{table, "drag_m", "mass_kg", "struck off"}, {table, "drag_m", "heaped_mass_kg", "heaped"}}}};
  return scree::examples::draw_plot(folder, "drag", title, panels);
}

/// sizes.svg and sizes.png from sizes.csv.
inline std::string draw_sizes(const std::filesystem::path& folder) {
  using scree::examples::Panel;
  std::vector<Panel> panels;
  for (const std::string shape : {"aligned", "pyramid", "flat", "sphere"}) {
    panels.push_back({"Shape: " + shape,
                      "upper opening of the sieve class, m",
                      "share of the class",
                      {{"sizes.csv", "below_m", shape + "_requested", "requested"},
                       {"sizes.csv", "below_m", shape + "_generated", "generated"}}});
  }
  return scree::examples::draw_plot(folder, "sizes", "Requested and generated grain sizes", panels);
}

} // namespace drag
