#include "support/workbench.hpp"

#include "scree/core/archive.hpp"
#include "scree/io/annotate.hpp"
#include "scree/io/checkpoint_file.hpp"
#include "scree/measure/state_hash.hpp"
#include "scree/simulation/step_times.hpp"
#include "support/grains_vtk.hpp"
#include "support/png.hpp"
#include "support/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <utility>

namespace scree::examples {

Workbench::Workbench(std::string name, std::string brief, int argc, const char* const* argv)
    : name_{std::move(name)},
      argc_{argc},
      argv_{argv},
      options_{name_, std::move(brief)},
      fidelity_{Options::peek(argc, argv, "fidelity").value_or("desk")},
      rock_{desk()} {
  options_.group("Run");
  options_.add("fidelity", fidelity_, {"desk", "lab"}, "which set of defaults");
  options_.add("out", out_, {}, "folder for the results; none: results/" + name_ + "-FIDELITY-K");
  options_.add("seed", seed_, {0.0, 9e15}, "of all random numbers");
  options_.add("threads", threads_, {0.0, 1024.0},
               "0: one for each processor; the results are the same for any");
  options_.add("step_safety", step_safety_, {0.01, 1.0}, "share of the critical time step");
  options_.group("Watch: what ends a run that has gone wrong");
  options_.add("watch.overlap", bounds_.overlap, {1e-6, 10.0},
               "of a contact, over the radius of the smallest sphere in it, at most");
  options_.add("watch.speed", bounds_.speed, {1e-6, 1e9, "m/s"}, "of a grain, at most");
  rig_ = rock_.rig();
  bind(options_, rock_, rig_);
}

void Workbench::begin() {
  options_.parse(argc_, argv_);
  watchdog_.emplace(bounds_);
  folder_ = results_folder(out_, name_ + "-" + fidelity_);
  options_.write_toml(folder_ / "input.toml");
  summary_["program"] = name_;
  summary_["finished"] = false;
  summary_["versions"] = versions();
  summary_["input"] = options_.json();
  summary_["defaults_not_in_the_paper"] = options_.not_in_the_paper();
  save();
}

std::string Workbench::title(const std::string& of) const {
  return fmt::format("{}, {} fidelity, seed {}", of, fidelity_, seed_);
}

void Workbench::watch(const Simulation<>& simulation, const Stage& stage) {
  (*watchdog_)(simulation);
  grain_steps_ += static_cast<double>(simulation.bodies().size());
  progress_(stage.share, fmt::format("{}: {} grains", stage.name, simulation.bodies().size()));
}

void Workbench::show_trouble(const Simulation<>& simulation) {
  progress_.close();
  try {
    const auto grains = folder_ / "trouble.vtp", state = folder_ / "trouble.checkpoint";
    write_grains(grains, simulation.bodies());
    ArchiveWriter writer;
    writer(simulation);
    write_checkpoint(state, name_, writer.bytes());
    fmt::print(stderr, "the grains at that moment are in {}, the whole state in {}\n", grains.string(),
               state.string());
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
}

void Workbench::plot(const std::string& name, const std::string& title, const std::vector<Panel>& panels) {
  if (const std::string complaint = draw_plot(folder_, name, title, panels); !complaint.empty()) {
    progress_.close();
    fmt::print(stderr, "{}\n", complaint);
  }
}

void Workbench::view(const std::string& name, const Simulation<>& simulation,
                     const Eigen::AlignedBox3d& scene, bool cut, const std::string& caption,
                     const std::function<void(Renderer&)>& add) {
  // Above the scene there is room for grains that stick out, and for the caption above these.
  const double across = scene.sizes().x(), below = 0.05 * across, above = 0.12 * across;
  Camera camera;
  camera.target = scene.center() + 0.5 * (above - below) * Vector::UnitZ();
  camera.width = 1.08 * across;
  constexpr int width = 1400;
  const double aspect = (scene.sizes().z() + below + above) / camera.width;
  Renderer renderer{width, std::clamp(static_cast<int>(width * aspect), 400, 2 * width), camera};
  if (cut) {
    renderer.cut({scene.center().cwiseProduct(Vector{1.0, 0.0, 1.0}), -Vector::UnitY()});
  }
  const auto& bodies = simulation.bodies();
  for (std::size_t s = 0; s < bodies.sphere_count(); ++s) {
    const auto& sphere = bodies.spheres()[s];
    const auto body = static_cast<std::uint32_t>(bodies.id(bodies.body_of(s)));
    renderer.sphere(to_eigen(sphere.position), static_cast<double>(sphere.radius), rock_colour(body), body);
  }
  renderer.uncut();
  add(renderer);
  Image image = renderer.image();
  draw_scale_bar(image, renderer.pixels_per_metre());
  draw_text(image, 24, 20, caption);
  write_png(folder_ / (name + ".png"), image);
}

void Workbench::finish(const Simulation<>& simulation) {
  const StepTimes& t = simulation.times();
  const double all = progress_.elapsed();
  summary_["wall_time_s"] = all;
  summary_["steps"] = simulation.steps();
  summary_["time_step_s"] =
      simulation.steps() > 0 ? simulation.time() / static_cast<double>(simulation.steps()) : 0.0;
  summary_["grain_steps_per_s"] = t.total() > 0.0 ? grain_steps_ / t.total() : 0.0;
  summary_["time_shares"] = {{"search", t.search / all},
                             {"contact", t.contact / all},
                             {"walls", t.walls / all},
                             {"integration", t.motion / all},
                             {"other", 1.0 - t.total() / all}};
  summary_["state_hash"] = fmt::format("{:016x}", state_hash(simulation.bodies()));
  summary_["finished"] = true;
  save();
  progress_.close();
  fmt::print("results: {}\n", folder_.string());
}

void Workbench::fail(const std::string& reason) {
  if (!folder_.empty()) {
    summary_["error"] = reason;
    save();
  }
}

void Workbench::save() const {
  write_json(folder_ / "summary.json", summary_);
}

int run_experiment(const std::string& name, const std::string& brief, int argc, const char* const* argv,
                   const std::function<void(Workbench&)>& work) {
  try {
    Workbench bench{name, brief, argc, argv};
    try {
      work(bench);
    } catch (const HelpWanted&) {
      throw;
    } catch (const std::exception& error) {
      bench.fail(error.what());
      throw;
    }
    return 0;
  } catch (const HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return 2;
  }
}

} // namespace scree::examples
