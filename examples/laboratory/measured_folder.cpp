#include "laboratory/measured_folder.hpp"

#include "scree/io/csv.hpp"
#include "scree/laboratory/rock_parameters.hpp"
#include "support/options_toml.hpp"
#include "support/rock_options.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace scree::examples {

namespace {

/// One calibration.toml, and how its faults are told.
struct Source {
  std::string file;

  [[noreturn]] void refuse(const toml::node& node, const std::string& why) const {
    throw file_error(file, node.source().begin.line, why);
  }
  [[nodiscard]] const toml::table& table(const toml::node& node, const std::string& name) const {
    if (const toml::table* found = node.as_table()) {
      return *found;
    }
    refuse(node, message(name, " must be a table"));
  }
  [[nodiscard]] std::string text(const toml::node& node, const std::string& name) const {
    if (!node.is_string()) {
      refuse(node, message(name, " must be a text"));
    }
    return *node.value<std::string>();
  }
  [[nodiscard]] bool truth(const toml::node& node, const std::string& name) const {
    if (!node.is_boolean()) {
      refuse(node, message(name, " must be true or false"));
    }
    return *node.value<bool>();
  }
  [[nodiscard]] double number(const toml::node& node, const std::string& name) const {
    if (!node.is_number()) {
      refuse(node, message(name, " must be a number"));
    }
    return detail::toml_number_of(node);
  }
  [[nodiscard]] std::vector<std::string> texts(const toml::node& node, const std::string& name) const {
    std::vector<std::string> out;
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& item : *list) {
        out.push_back(text(item, name));
      }
    }
    if (out.empty()) {
      refuse(node, message(name, " must be a list of texts"));
    }
    return out;
  }
  /// A table that `node` names, beside this file.
  [[nodiscard]] std::filesystem::path table_file(const toml::node& node, const std::string& name) const {
    auto out = std::filesystem::path{file}.parent_path() / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(out, error)) {
      refuse(node, message("no such file: ", out.string()));
    }
    return out;
  }
};

/// A plan without parameters and experiments.
Plan read_rock(const Source& source, const std::filesystem::path& folder, const toml::table& top, bool desk) {
  RockOptions rock{desk};
  Options options{"calibrate", ""};
  Material rig = rock.rig();
  bind(options, rock, rig);
  for (const char* name : {"rock", "rig"}) {
    if (const toml::node* node = top.get(name)) {
      detail::read_toml(options.entries(), source.table(*node, name), message(name, "."), source.file);
    }
  }
  return {.folder = folder, .model = {rock.sample(rig)}, .rock = text_of(rock, rig)};
}

void read_parameters(const Source& source, const toml::table& parameters, Plan& plan) {
  for (const auto& [key, node] : parameters) {
    const std::string name{key.str()};
    const toml::table& table = source.table(node, "parameters." + name);
    const RockParameter* known = nullptr;
    try {
      known = &rock_parameter(name);
    } catch (const Error& error) {
      source.refuse(node, error.what());
    }
    Parameter parameter{.name = name,
                        .unit = std::string{known->unit},
                        .logarithmic = known->logarithmic,
                        .touches = kinds_that_show(*known)};
    double start = std::nan("");
    for (const auto& [entry, value] : table) {
      const std::string what = message("parameters.", name, ".", entry.str());
      const std::map<std::string_view, double*> fields{
          {"least", &parameter.least}, {"most", &parameter.most}, {"start", &start}};
      const auto field = fields.find(entry.str());
      if (field == fields.end()) {
        source.refuse(value, message("there is no '", what, "'; a parameter has least, most and start"));
      }
      *field->second = source.number(value, what);
    }
    if (!table.contains("least") || !table.contains("most")) {
      source.refuse(node, message("parameters.", name, " needs bounds: least and most"));
    }
    if (std::isnan(start)) {
      start = known->get(plan.model);
    }
    try {
      parameter.check();
      require(message("parameters.", name, ".start"), start,
              {parameter.least, parameter.most, parameter.unit});
    } catch (const Error& error) {
      source.refuse(node, error.what());
    }
    plan.space.push_back(std::move(parameter));
    plan.start.push_back(start);
  }
}

/// The columns of the data that are observables, as these; others are refused.
void read_data(const std::filesystem::path& file, PlannedExperiment& e) {
  const CsvTable data = read_csv(file);
  const auto observables = e.experiment->observables();
  for (const std::string& column : data.columns) {
    const auto found = std::find_if(observables.begin(), observables.end(),
                                    [&](const Observable& o) { return o.name == column; });
    if (found == observables.end()) {
      std::string known;
      for (const Observable& o : observables) {
        known += message(known.empty() ? "" : ", ", o.name);
      }
      throw Error(message(file.string(), ": column ", column, " is nothing that the experiment '", e.kind,
                          "' gives; that is ", known));
    }
    const auto values = data.column(column);
    e.used.push_back(static_cast<std::size_t>(found - observables.begin()));
    e.measured.push_back({.name = message(e.name, ".", column),
                          .replicates = {values.begin(), values.end()},
                          .logarithmic = found->logarithmic});
  }
}

/// Of an observable that is a piece of a curve, like loading_3: loading; empty for others.
std::string curve_of(const std::string& observable) {
  const std::size_t line = observable.rfind('_');
  const bool numbered = line != std::string::npos && line + 1 < observable.size() &&
                        observable.find_first_not_of("0123456789", line + 1) == std::string::npos;
  return numbered ? observable.substr(0, line) : "";
}

/// Each curve is a replicate, reduced as those of the simulations are. What some of them do not show is left
/// out.
void read_curves(const std::vector<std::filesystem::path>& files, PlannedExperiment& e) {
  std::vector<std::vector<double>> replicates;
  for (const std::filesystem::path& file : files) {
    replicates.push_back(e.experiment->reduce(read_csv(file)));
  }
  const auto observables = e.experiment->observables();
  for (std::size_t k = 0; k < observables.size(); ++k) {
    Measured measured{.name = message(e.name, ".", observables[k].name),
                      .replicates = {},
                      .logarithmic = observables[k].logarithmic};
    for (const auto& values : replicates) {
      measured.replicates.push_back(values[k]);
    }
    if (std::all_of(measured.replicates.begin(), measured.replicates.end(),
                    [](double value) { return std::isfinite(value); })) {
      e.used.push_back(k);
      e.measured.push_back(std::move(measured));
    }
  }
  e.curve = files.front();
}

void keep_only(const Source& source, const toml::node& node, const std::vector<std::string>& wanted,
               PlannedExperiment& e) {
  std::vector<std::size_t> used;
  std::vector<Measured> measured;
  for (const std::string& name : wanted) {
    const auto found = std::find_if(e.measured.begin(), e.measured.end(),
                                    [&](const Measured& m) { return m.name == e.name + "." + name; });
    if (found == e.measured.end()) {
      source.refuse(node, message("use: '", name, "' was not measured in ", e.name));
    }
    used.push_back(e.used[static_cast<std::size_t>(found - e.measured.begin())]);
    measured.push_back(*found);
  }
  e.used = std::move(used);
  e.measured = std::move(measured);
}

void read_experiment(const Source& source, const std::string& name, const toml::table& table,
                     const toml::node& node, bool desk, Data wanted, Plan& plan) {
  PlannedExperiment e;
  e.name = name;
  const toml::node* kind = table.get("kind");
  e.kind = kind != nullptr ? source.text(*kind, "kind") : name;
  try {
    e.experiment = make_experiment(e.kind, desk);
  } catch (const Error& error) {
    source.refuse(node, error.what());
  }
  Options options{"calibrate", ""};
  e.experiment->bind(options);
  static const std::set<std::string_view> own{"kind", "data",           "curves",   "curve",
                                              "use",  "standard_error", "held_out", "measured"};
  detail::read_toml(options.entries(), table, "", source.file, own);
  e.setup = options.json().dump();

  if (const toml::node* measured = table.get("measured");
      measured != nullptr && !source.truth(*measured, "measured")) {
    for (const char* of_data : {"data", "curves", "curve", "use", "standard_error", "held_out"}) {
      if (const toml::node* there = table.get(of_data)) {
        source.refuse(*there, message("experiments.", name, " is not measured yet: it has no ", of_data));
      }
    }
    plan.possible.push_back(std::move(e));
    return;
  }
  if (const toml::node* held_out = table.get("held_out")) {
    e.held_out = source.truth(*held_out, "held_out");
  }
  const toml::node *data = table.get("data"), *curves = table.get("curves");
  if ((data == nullptr) == (curves == nullptr)) {
    source.refuse(node, message("experiments.", name, " needs either data or curves"));
  }
  if (wanted == Data::none) {
    plan.experiments.push_back(std::move(e));
    return;
  }
  if (data != nullptr) {
    read_data(source.table_file(*data, source.text(*data, "data")), e);
  } else {
    std::vector<std::filesystem::path> files;
    for (const std::string& table_name : source.texts(*curves, "curves")) {
      files.push_back(source.table_file(*curves, table_name));
    }
    read_curves(files, e);
  }
  if (const toml::node* use = table.get("use")) {
    keep_only(source, *use, source.texts(*use, "use"), e);
  }
  if (const toml::node* curve = table.get("curve")) {
    e.curve = plan.folder / source.text(*curve, "curve");
  }
  if (const toml::node* errors = table.get("standard_error")) {
    for (const auto& [key, value] : source.table(*errors, "standard_error")) {
      const std::string observable = message(e.name, ".", key.str());
      const auto found = std::find_if(e.measured.begin(), e.measured.end(),
                                      [&observable](const Measured& m) { return m.name == observable; });
      if (found == e.measured.end()) {
        source.refuse(value, message("standard_error: '", key.str(), "' was not measured in ", e.name));
      }
      found->error = source.number(value, "standard_error");
    }
  }
  for (Measured& m : e.measured) {
    m.specimens = e.name;
    m.kind = e.kind;
    m.curve = curve_of(m.name);
    try {
      m.check();
    } catch (const Error& error) {
      source.refuse(node, error.what());
    }
  }
  plan.experiments.push_back(std::move(e));
}

/// The paper's: density from the bulk density, stiffness from the oedometer, friction from the heap; those of
/// them that there are.
void default_steps(Plan& plan) {
  struct Rule {
    const char *parameter, *kind, *observable;
    double tolerance;
    std::size_t iterations;
  };
  // The tolerance of the density is the paper's, section 4.3; the others and the numbers of iterations of
  // these are ours.
  static constexpr Rule rules[] = {{"particle_density", "bulk_density", "bulk_density_kg_m3", 1e-3, 4},
                                   {"normal_stiffness", "oedometer", "modulus_Pa", 2e-2, 5},
                                   {"friction", "angle_of_repose", "angle_deg", 0.5, 5}};
  for (const Rule& rule : rules) {
    const auto parameter = std::find_if(plan.space.begin(), plan.space.end(),
                                        [&](const Parameter& p) { return p.name == rule.parameter; });
    std::size_t at = 0;
    bool found = false;
    for (const PlannedExperiment& e : plan.experiments) {
      for (const Measured& m : e.measured) {
        if (!found && parameter != plan.space.end() && e.kind == rule.kind &&
            m.name == message(e.name, ".", rule.observable)) {
          plan.steps.push_back({static_cast<std::size_t>(parameter - plan.space.begin()), at, rule.tolerance,
                                rule.iterations});
          found = true;
        }
        ++at;
      }
    }
    if (parameter != plan.space.end() && !found) {
      plan.remarks.push_back(message("the paper's sequence leaves ", rule.parameter, " as it is: no ",
                                     rule.observable, " was measured"));
    }
  }
}

} // namespace

Plan read_plan(const std::filesystem::path& folder, Data data) {
  const Source source{(folder / "calibration.toml").string()};
  const toml::table top = detail::parsed_toml(source.file);
  static const std::set<std::string_view> known{"fidelity", "parameters", "rock", "rig", "experiments"};
  for (const auto& [key, node] : top) {
    if (!known.contains(key.str())) {
      source.refuse(node, message("there is no '", key.str(),
                                  "'; the file has fidelity, parameters, rock, rig and experiments"));
    }
  }
  bool desk = true;
  if (const toml::node* node = top.get("fidelity")) {
    const std::string fidelity = source.text(*node, "fidelity");
    if (fidelity != "desk" && fidelity != "lab") {
      source.refuse(*node, message("fidelity = \"", fidelity, "\" is not one of desk, lab"));
    }
    desk = fidelity == "desk";
  }
  Plan plan = read_rock(source, folder, top, desk);
  const auto wanted = [&](const char* name) -> const toml::table& {
    const toml::node* node = top.get(name);
    if (node == nullptr || source.table(*node, name).empty()) {
      throw file_error(source.file, 1, message("the file has no [", name, ".NAME]"));
    }
    return *node->as_table();
  };
  read_parameters(source, wanted("parameters"), plan);
  for (const auto& [key, node] : wanted("experiments")) {
    const std::string name{key.str()};
    read_experiment(source, name, source.table(node, "experiments." + name), node, desk, data, plan);
  }
  std::stable_partition(plan.experiments.begin(), plan.experiments.end(),
                        [](const PlannedExperiment& e) { return !e.held_out; });
  default_steps(plan);
  return plan;
}

} // namespace scree::examples
