/// \brief A dragline bucket on two ropes digs a metre through a bed of crushed rock (Coetzee, Els & Dymond 2010).
/// \smoke --rock.size_factor 3 --bed.length 0.8 --bed.width 0.4 --bed.depth 0.2 --bed.unbalanced 0.3 --rig.bucket_start 0.1 --rig.drag_distance 0.05

#include "parameters.hpp"
#include "record.hpp"
#include "sizes.hpp"

#include "scree/geometry/mesh_measures.hpp"
#include "scree/io/stl.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "scree/measure/state_hash.hpp"
#include "support/progress.hpp"
#include "support/results.hpp"
#include "support/stopwatch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

namespace {

/// The physics of this program. Another law, search, integrator or kind of wall is another line here.
struct DragModel : scree::DefaultModel {
  using Contact = scree::LinearSpring<>;
  using Neighbours = scree::VerletList<scree::CellGrid>;
  using Integrator = scree::Leapfrog;
  using Walls = scree::Walls<scree::Fixed, scree::RopeCoupled>;
};

using Rig = scree::DragRig<DragModel>;
using Json = nlohmann::ordered_json;
namespace ex = scree::examples;

Json described(const scree::BedReport& bed) {
  return {{"porosity", bed.porosity},
          {"poured_porosity", bed.poured_porosity},
          {"bulk_density_kg_m3", bed.bulk_density},
          {"unbalanced_force_ratio", bed.unbalanced},
          {"moving_share", bed.moving},
          {"at_rest", bed.at_rest},
          {"bodies_poured", bed.poured},
          {"bodies", bed.kept},
          {"simulated_s", bed.duration}};
}

Json described(const scree::BucketBody& bucket) {
  const auto& i = bucket.body.inertia;
  return {{"facets", bucket.surface.facets.size()},
          {"mass_kg", bucket.body.mass},
          {"centre_m", {bucket.body.centre.x(), bucket.body.centre.y(), bucket.body.centre.z()}},
          {"inertia_xx_yy_zz_kg_m2", {i(0, 0), i(1, 1), i(2, 2)}},
          {"interior_m3", scree::volume(bucket.interior)}};
}

/// Runs the experiment and keeps summary.json up to date.
class Run {
public:
  Run(drag::Parameters parameters, const ex::Options& options)
      : p_{std::move(parameters)}, folder_{ex::results_folder(p_.out, "drag-" + p_.fidelity)} {
    options.write_toml(folder_ / "input.toml");
    summary_["program"] = "drag";
    summary_["finished"] = false;
    summary_["versions"] = ex::versions();
    summary_["input"] = options.json();
    summary_["defaults_not_in_the_paper"] = options.not_in_the_paper();
    save();
  }

  void operator()() {
    try {
      work();
    } catch (const std::exception& error) {
      summary_["error"] = error.what();
      save();
      throw;
    }
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

private:
  void work() {
    std::vector<std::string> remarks;
    const scree::BucketBody bucket = p_.dragline.bucket(remarks);
    scree::write_stl_binary(folder_ / "bucket.stl", bucket.surface);
    summary_["bucket"] = described(bucket);
    summary_["remarks"] = remarks;
    for (const std::string& remark : remarks) {
      progress_.close();
      fmt::print("{}\n", remark);
    }
    Rig rig{
        p_.dragline.setup, bucket, {.neighbours = {.share = p_.skin_share}, .step_safety = p_.step_safety}};
    make_bed(rig);
    dig(rig);
    finish(rig);
  }

  void make_bed(Rig& rig) {
    const scree::Assembly assembly = p_.rock.assembly();
    const scree::BedReport& bed =
        rig.make_bed(assembly, [&](const auto& simulation, const scree::Stage& stage) {
          // A bed falls and comes to rest within a few times the fall through its depth.
          const double expected = 4.0 * std::sqrt(2.0 * p_.dragline.setup.bed_depth / 9.81);
          count(simulation);
          progress_(bed_share * std::min(0.99, std::max(stage.share, simulation.time() / expected)),
                    fmt::format("bed: {} {} grains", stage.name, simulation.bodies().size()));
        });
    drag::write_sizes(folder_ / "sizes.csv", assembly, bed.drawn);
    complain(drag::draw_sizes(folder_));
    summary_["bed"] = described(bed);
    summary_["time_step_s"] = rig.simulation().time_step();
    save();
    progress_.close();
    fmt::print(
        "bed: {} grains of {} spheres, porosity {:.3f}, bulk density {:.0f} kg/m3, time step {:.3g} s\n",
        bed.kept, rig.simulation().bodies().sphere_count(), bed.porosity, bed.bulk_density,
        rig.simulation().time_step());
    if (!bed.at_rest) {
      fmt::print("bed: not at rest within bed.patience = {} s: unbalanced force ratio {:.2g}, {:.2g} of the "
                 "grains faster than bed.speed\n",
                 p_.dragline.setup.bed.rest.patience, bed.unbalanced, bed.moving);
    }
  }

  void dig(Rig& rig) {
    const auto watch = [&](const auto& simulation) { count(simulation); };
    rig.place_bucket(watch);
    summary_["placed_pitch_deg"] = drag::degrees(rig.placed_pitch());
    drag::Table table{folder_};
    drag::Frames frames{folder_};
    double next_frame = 0.0, next_picture = 0.0;
    scree::DragSample sample = rig.sample();
    const auto record = [&] {
      const ex::Stopwatch watching{output_};
      table.add(sample);
      if (sample.drag >= next_frame) {
        frames.add(rig);
        next_frame += p_.frame_interval;
      }
      if (sample.drag >= next_picture - 1e-9) {
        drag::draw_view(folder_ / fmt::format("view_{:.2f}m.png", next_picture), rig, sample);
        complain(drag::draw_plots(folder_, title()));
        next_picture += p_.picture_interval;
      }
    };
    record();
    while (!rig.done()) {
      rig.advance(p_.sample_interval, watch);
      {
        const ex::Stopwatch watching{observers_};
        sample = rig.sample();
      }
      record();
      progress_(bed_share + (1.0 - bed_share) * sample.drag / p_.dragline.setup.drag_distance,
                fmt::format("drag {:.2f} m, {:.0f} N, pitch {:.1f}°, {:.1f} kg", sample.drag, sample.force,
                            drag::degrees(sample.attitude.pitch), sample.fill.struck));
    }
    {
      const ex::Stopwatch watching{output_};
      drag::draw_view(folder_ / "view_end.png", rig, sample);
      frames.add(rig);
    }
    summary_["end"] = {{"drag_m", sample.drag},
                       {"force_N", sample.force},
                       {"pitch_deg", drag::degrees(sample.attitude.pitch)},
                       {"mass_kg", sample.fill.struck},
                       {"heaped_mass_kg", sample.fill.heaped}};
  }

  void finish(const Rig& rig) {
    {
      const ex::Stopwatch watching{output_};
      complain(drag::draw_plots(folder_, title()));
    }
    const scree::StepTimes& t = rig.simulation().times();
    const double all = progress_.elapsed(), stepping = t.total();
    summary_["wall_time_s"] = all;
    summary_["steps"] = rig.simulation().steps();
    summary_["grain_steps_per_s"] = grain_steps_ / stepping;
    summary_["sphere_steps_per_s"] = sphere_steps_ / stepping;
    summary_["time_shares"] = {{"search", t.search / all},
                               {"contact", t.contact / all},
                               {"walls", t.walls / all},
                               {"integration", t.motion / all},
                               {"observers", observers_ / all},
                               {"output", output_ / all},
                               {"other", 1.0 - (stepping + observers_ + output_) / all}};
    summary_["list_renewals"] = rig.simulation().list_renewals();
    summary_["state_hash"] = fmt::format("{:016x}", scree::state_hash(rig.simulation().bodies()));
    summary_["finished"] = true;
    save();
    progress_.close();
    fmt::print("{:.3g} grain-steps per second, {} in all\n", grain_steps_ / stepping,
               ex::clock_text(progress_.elapsed()));
  }

  void count(const auto& simulation) {
    grain_steps_ += static_cast<double>(simulation.bodies().size());
    sphere_steps_ += static_cast<double>(simulation.bodies().sphere_count());
  }
  void complain(const std::string& complaint) {
    if (!complaint.empty() && complaint != last_complaint_) {
      progress_.close();
      fmt::print(stderr, "{}\n", complaint);
      last_complaint_ = complaint;
    }
  }
  [[nodiscard]] std::string title() const {
    return fmt::format("Dragline bucket, {} fidelity, seed {}", p_.fidelity, p_.dragline.setup.seed);
  }
  void save() const { ex::write_json(folder_ / "summary.json", summary_); }

  static constexpr double bed_share = 0.35; // of the wall time; ours, as seen at desk fidelity

  drag::Parameters p_;
  std::filesystem::path folder_;
  Json summary_;
  ex::Progress progress_;
  double grain_steps_ = 0.0, sphere_steps_ = 0.0;
  double observers_ = 0.0, output_ = 0.0; // s
  std::string last_complaint_;
};

} // namespace

int main(int argc, char** argv) {
  try {
    const std::string fidelity = ex::Options::peek(argc, argv, "fidelity").value_or("desk");
    drag::Parameters parameters = drag::defaults(fidelity);
    ex::Options options{"drag", "A dragline bucket on two ropes digs through a bed of crushed rock."};
    drag::bind(options, parameters);
    options.parse(argc, argv);
    drag::apply(parameters);
    Run run{parameters, options};
    run();
    fmt::print("results: {}\n", run.folder().string());
    return 0;
  } catch (const ex::HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "drag: {}\n", error.what());
    return 2;
  }
}
