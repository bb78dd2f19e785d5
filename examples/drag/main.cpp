/// \brief A dragline bucket on two ropes digs a metre through a bed of crushed rock (Coetzee, Els & Dymond 2010).
/// \smoke --rock.size_factor 3 --bed.length 0.8 --bed.width 0.4 --bed.depth 0.2 --bed.unbalanced 0.3 --rig.bucket_start 0.1 --rig.drag_distance 0.05

#include "parameters.hpp"
#include "record.hpp"
#include "resume.hpp"
#include "sizes.hpp"

#include "scree/geometry/mesh_measures.hpp"
#include "scree/io/stl.hpp"
#include "scree/laboratory/drag_rig.hpp"
#include "scree/measure/state_hash.hpp"
#include "scree/measure/watchdog.hpp"
#include "support/checkpoints.hpp"
#include "support/progress.hpp"
#include "support/results.hpp"
#include "support/stopwatch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace {

/// The physics of this program. Another law, search, integrator or kind of wall is another line here.
struct DragModel : scree::DefaultModel {
  using Contact = scree::LinearSpring<>;
  using Neighbours = scree::VerletList<scree::CellGrid>;
  using Integrator = scree::Leapfrog;
  using Walls = scree::Walls<scree::Fixed, scree::RopeCoupled>;
  using Rest = scree::RestingRegions;
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

/// The input, but for what changes no result.
std::string text_of(const ex::Options& options) {
  Json input = options.json();
  for (const char* name : {"out", "threads", "checkpoint_interval"}) {
    input.erase(name);
  }
  for (auto entry = input.begin(); entry != input.end();) {
    entry = entry.key().starts_with("watch.") ? input.erase(entry) : std::next(entry);
  }
  return input.dump();
}

/// Runs the experiment and keeps summary.json up to date.
class Run {
public:
  /// \param begun the folder of a run that was begun, to go on with it; empty for a new one
  Run(drag::Parameters parameters, const ex::Options& options, const std::filesystem::path& begun)
      : p_{std::move(parameters)},
        folder_{begun.empty() ? ex::results_folder(p_.out, "drag-" + p_.fidelity) : begun},
        going_on_{!begun.empty()},
        input_{text_of(options)},
        checkpoints_{folder_ / "checkpoint", "a drag", p_.checkpoint_interval,
                     [this](const std::string& complaint) { complain(complaint); }},
        watch_{p_.bounds} {
    if (!going_on_) {
      options.write_toml(folder_ / "input.toml");
    }
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
    } catch (const ex::Stopped&) {
      summary_["stopped"] = true;
      save();
      progress_.close();
      throw;
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
    if (going_on_) {
      go_on(rig);
    }
    try {
      make_bed(rig);
      dig(rig);
    } catch (const scree::Trouble&) {
      show_trouble(rig);
      throw;
    }
    finish(rig);
    checkpoints_.remove();
  }

  /// What is needed to look for the cause of an error, as far as it can be written.
  void show_trouble(const Rig& rig) {
    try {
      ex::write_grains(folder_ / "trouble.vtp", rig.simulation().bodies());
      checkpoints_.keep_aside(State<const Run, const Rig>{*this, rig}, folder_ / "trouble.checkpoint");
      complain(fmt::format("the grains at that moment are in {}, the whole state in {}",
                           (folder_ / "trouble.vtp").string(), (folder_ / "trouble.checkpoint").string()));
    } catch (const scree::Error& error) {
      complain(error.what());
    }
  }

  /// All that the rest of a run depends on.
  template <class AnyRun, class AnyRig>
  struct State {
    AnyRun& run;
    AnyRig& rig;

    template <class Self, class Archive>
    static void fields(Self& self, Archive& archive) {
      auto& r = self.run;
      std::string input = r.input_;
      archive(input);
      if constexpr (Archive::reading) {
        if (input != r.input_) {
          archive.fail("is of another input than that of input.toml");
        }
      }
      double elapsed = r.progress_.elapsed();
      bool recording = r.table_.has_value();
      std::uintmax_t written = recording ? r.table_->bytes_on_disk() : 0;
      archive(elapsed, r.grain_steps_, r.resting_steps_, r.sphere_steps_, r.observers_, r.output_,
              r.next_frame_, r.next_picture_, r.watch_, recording, written);
      if constexpr (Archive::reading) {
        r.progress_.add_earlier(elapsed);
        if (recording) {
          r.table_.emplace(r.folder_, written);
          r.frames_.emplace(r.folder_);
        }
      }
      if (recording) {
        archive(*r.frames_);
      }
      archive(self.rig);
    }
  };
  void keep(const Rig& rig) { checkpoints_(State<const Run, const Rig>{*this, rig}); }

  void go_on(Rig& rig) {
    State<Run, Rig> state{*this, rig};
    const auto remark = checkpoints_.read(state);
    if (!remark) {
      fmt::print("no checkpoint was written before it stopped: begins anew\n");
      return;
    }
    if (!remark->empty()) {
      fmt::print("{}: the checkpoint before is taken\n", *remark);
    }
    fmt::print("goes on at {:.4f} s of simulated time, step {}\n", rig.simulation().time(),
               rig.simulation().steps());
  }

  void make_bed(Rig& rig) {
    const scree::Assembly assembly = p_.rock.assembly();
    const scree::BedReport& bed =
        rig.make_bed(assembly, [&](const auto& simulation, const scree::Stage& stage) {
          // A bed falls and comes to rest within a few times the fall through its depth.
          const double expected = 4.0 * std::sqrt(2.0 * p_.dragline.setup.bed_depth / 9.81);
          count(simulation);
          watch_(simulation);
          keep(rig);
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
    const auto watch = [&](const auto& simulation) {
      count(simulation);
      watch_(simulation);
      keep(rig);
    };
    rig.place_bucket(watch);
    summary_["placed_pitch_deg"] = drag::degrees(rig.placed_pitch());
    scree::DragSample sample;
    const auto record = [&] {
      const ex::Stopwatch watching{output_};
      table_->add(sample);
      if (sample.drag >= next_frame_) {
        frames_->add(rig);
        next_frame_ += p_.frame_interval;
      }
      if (sample.drag >= next_picture_ - 1e-9) {
        drag::draw_view(folder_ / fmt::format("view_{:.2f}m.png", next_picture_), rig, sample);
        complain(drag::draw_plots(folder_, title()));
        next_picture_ += p_.picture_interval;
      }
    };
    if (!table_) {
      table_.emplace(folder_);
      frames_.emplace(folder_);
      sample = rig.sample();
      record();
    }
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
      frames_->add(rig);
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
    summary_["resting_share"] = resting_steps_ / grain_steps_;
    summary_["sphere_steps_per_s"] = sphere_steps_ / stepping;
    summary_["time_shares"] = {{"search", t.search / all},
                               {"contact", t.contact / all},
                               {"walls", t.walls / all},
                               {"integration", t.motion / all},
                               {"observers", observers_ / all},
                               {"output", output_ / all},
                               {"other", 1.0 - (stepping + observers_ + output_) / all}};
    summary_["largest_overlap_over_radius"] = watch_.largest_overlap();
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
    resting_steps_ += static_cast<double>(simulation.resting_count());
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
  bool going_on_;
  std::string input_;
  ex::Checkpoints checkpoints_;
  scree::Watchdog watch_;
  std::optional<drag::Table> table_; // from when the bucket is at rest on the bed
  std::optional<drag::Frames> frames_;
  double next_frame_ = 0.0, next_picture_ = 0.0; // m, of drag
  Json summary_;
  ex::Progress progress_;
  double grain_steps_ = 0.0, resting_steps_ = 0.0, sphere_steps_ = 0.0; // of grains left alone: the second
  double observers_ = 0.0, output_ = 0.0;                               // s
  std::string last_complaint_;
};

} // namespace

int main(int argc, char** argv) {
  const ex::StopSignals signals;
  std::filesystem::path folder;
  try {
    const std::filesystem::path begun = ex::Options::peek(argc, argv, "resume").value_or("");
    const std::string input = (begun / "input.toml").string();
    std::vector<const char*> words{argv, argv + argc};
    if (!begun.empty()) {
      words = drag::command_of(begun, input, argc, argv);
    }
    const auto count = static_cast<int>(words.size());
    const std::string fidelity = ex::Options::peek(count, words.data(), "fidelity").value_or("desk");
    drag::Parameters parameters = drag::defaults(fidelity);
    ex::Options options{"drag", "A dragline bucket on two ropes digs through a bed of crushed rock. "
                                "--resume FOLDER goes on with a run that was stopped."};
    drag::bind(options, parameters);
    options.parse(count, words.data());
    drag::apply(parameters);
    Run run{parameters, options, begun};
    folder = run.folder();
    run();
    fmt::print("results: {}\n", folder.string());
    return 0;
  } catch (const ex::HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const ex::Stopped& stopped) {
    fmt::print(stderr, "drag: stopped by {}; its state is kept. To go on: drag --resume {}\n",
               stopped.signal == SIGINT ? "SIGINT" : "SIGTERM", folder.string());
    return 128 + stopped.signal;
  } catch (const std::exception& error) {
    fmt::print(stderr, "drag: {}\n", error.what());
    return 2;
  }
}
