#include "laboratory/dragline.hpp"
#include "laboratory/experiment.hpp"
#include "support/degree.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/drag_test.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scree::examples {

namespace {

constexpr const char* record_file = "drag.csv";

void write_table(const std::filesystem::path& folder, std::span<const DragSample> curve,
                 std::span<const DragRow> rows) {
  CsvWriter out{folder / record_file,
                {"time_s", "drag_m", "force_N", "pitch_deg", "depth_m", "mass_kg", "lag_m", "true_force_N"},
                "Forces are means since the row before, as the load cell reads them and as they are; lag is "
                "the rope wound in less the drag."};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const DragRow& r = rows[k];
    out.row({curve[k].time, r.drag, r.force, r.pitch / degree, r.depth, r.mass, r.lag, curve[k].force});
  }
}

/// What is read off the curves, beside the roughness of the force.
struct Curve {
  const char* name;
  std::vector<double> DragPieces::*means;
  double unit; ///< of the observable, in SI units
  bool logarithmic = false;
};
constexpr std::array kept_curves{
    Curve{"force_N", &DragPieces::force, 1.0}, Curve{"pitch_deg", &DragPieces::pitch, degree},
    Curve{"depth_m", &DragPieces::depth, 1.0}, Curve{"mass_kg", &DragPieces::mass, 1.0},
    Curve{"lag_m", &DragPieces::lag, 1.0, true}}; // force over stiffness of the rope

class DragExperiment final : public Experiment {
public:
  explicit DragExperiment(bool desk) : dragline_{desk} {}

  void bind(Options& options) override {
    dragline_.bind(options);
    options.add("record.interval", interval_, {1e-6, 10.0, "s"},
                "between two lines of the record, over which forces are means");
    options.add("record.pieces", pieces_, {1.0, 100.0}, "of the drag, over which the curves are means");
  }
  std::vector<Observable> observables() const override {
    std::vector<Observable> out;
    for (const Curve& curve : kept_curves) {
      for (std::size_t k = 1; k <= pieces_; ++k) {
        out.push_back({message(curve.name, "_", k), curve.logarithmic});
      }
    }
    out.push_back({"roughness"});
    return out;
  }
  CurveFile curve() const override {
    return {record_file, "drag_m", "force_N", "Force of both ropes", "drag, m", "N"};
  }
  std::vector<double> observe(const Conditions& conditions,
                              const std::filesystem::path& folder) const override {
    return detail::with_physics_of(conditions, [&]<class Model>(const Setup<Model>& physics) {
      DragTest<Model> test{setup(conditions), physics};
      const DragTestResult& r = test.run(detail::limited(conditions));
      if (!folder.empty()) {
        write_table(folder, r.curve, r.rows);
      }
      return reduced(r.rows);
    });
  }
  /// Of a table with the columns of drag.csv, as the load cell reads the force; but for the drag, those that
  /// it has not are not among the observables.
  std::vector<double> reduce(const CsvTable& measured) const override {
    std::vector<DragRow> rows(measured.column("drag_m").size());
    const auto read = [&](const char* name, double DragRow::*what, double unit) {
      const auto& known = measured.columns;
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        for (DragRow& row : rows) {
          row.*what = std::numeric_limits<double>::quiet_NaN();
        }
        return;
      }
      const std::span<const double> column = measured.column(name);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k].*what = column[k] * unit;
      }
    };
    read("drag_m", &DragRow::drag, 1.0);
    read("force_N", &DragRow::force, 1.0);
    read("pitch_deg", &DragRow::pitch, degree);
    read("depth_m", &DragRow::depth, 1.0);
    read("mass_kg", &DragRow::mass, 1.0);
    read("lag_m", &DragRow::lag, 1.0);
    return reduced(rows);
  }

private:
  [[nodiscard]] DragTestSetup setup(const Conditions& conditions) const {
    std::vector<std::string> remarks; // in the program `drag`
    DragTestSetup out{.sample = conditions.model.sample,
                      .rig = dragline_.setup,
                      .bucket = dragline_.bucket(remarks),
                      .gear = conditions.model.gear,
                      .interval = interval_,
                      .seed = conditions.seed,
                      .threads = conditions.threads};
    out.rig.bed.packing_friction *= conditions.model.packing_friction;
    return out;
  }
  [[nodiscard]] std::vector<double> reduced(std::span<const DragRow> rows) const {
    const DragPieces pieces = pieces_of(rows, dragline_.setup.drag_distance, pieces_);
    std::vector<double> out;
    for (const Curve& curve : kept_curves) {
      for (const double mean : pieces.*curve.means) {
        out.push_back(mean / curve.unit);
      }
    }
    out.push_back(pieces.roughness);
    return out;
  }

  Dragline dragline_;
  double interval_ = 0.01;
  std::uint64_t pieces_ = 4;
};

} // namespace

std::unique_ptr<Experiment> detail::make_drag_test(bool desk) {
  return std::make_unique<DragExperiment>(desk);
}

} // namespace scree::examples
