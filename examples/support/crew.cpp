#include "support/crew.hpp"

#include "scree/core/error.hpp"
#include "support/options.hpp"
#include "support/results.hpp"

#include <fmt/format.h>

#ifdef SCREE_MPI
#include <boost/mpi/collectives.hpp>
#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/serialization/string.hpp>
#endif

#include <cstdio>
#include <exception>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <vector>

namespace scree::examples {

#ifdef SCREE_MPI

namespace {

std::unique_ptr<boost::mpi::environment> environment;

} // namespace

CrewOfProgram::CrewOfProgram(int& argc, char**& argv) {
  // Runs have threads of their own, but only the first of each process speaks to the others.
  environment = std::make_unique<boost::mpi::environment>(argc, argv, boost::mpi::threading::funneled);
  const boost::mpi::communicator world;
  crew_.rank = static_cast<std::size_t>(world.rank());
  crew_.size = static_cast<std::size_t>(world.size());
  crew_.exchange = [world](const std::string& mine) {
    std::vector<std::string> all;
    boost::mpi::all_gather(world, mine, all);
    return all;
  };
  if (!first() && std::freopen("/dev/null", "w", stdout) == nullptr) {
    throw Error("/dev/null: cannot be opened");
  }
}

CrewOfProgram::~CrewOfProgram() {
  std::error_code ignored;
  if (!thrown_away_.empty()) {
    std::filesystem::remove_all(thrown_away_, ignored);
  }
  environment.reset();
}

void CrewOfProgram::fail() const {
  if (crew_.size > 1) {
    boost::mpi::environment::abort(2);
  }
}

#else

CrewOfProgram::CrewOfProgram(int&, char**&) {}
CrewOfProgram::~CrewOfProgram() = default;
void CrewOfProgram::fail() const {}

#endif

namespace {

std::filesystem::path begun_or_new(const std::string& wanted, const std::string& name, bool resume) {
  if (!resume) {
    return results_folder(wanted, name);
  }
  if (wanted.empty() || !std::filesystem::is_directory(wanted)) {
    throw Error("resume: --out must name the folder that was begun");
  }
  return wanted;
}

} // namespace

CrewFolders CrewOfProgram::folders(const std::string& wanted, const std::string& name, bool resume) {
  if (crew_.size == 1) {
    const auto folder = begun_or_new(wanted, name, resume);
    return {folder, folder};
  }
  const std::string made =
      first() ? std::filesystem::absolute(begun_or_new(wanted, name, resume)).string() : "";
  const std::filesystem::path common = crew_.exchange(made).at(0);
  if (first()) {
    return {common, common};
  }
  std::random_device entropy; // not scree::Random: processes of one machine must not meet
  thrown_away_ = std::filesystem::temp_directory_path() / message("scree_crew_", entropy(), entropy());
  std::filesystem::create_directories(thrown_away_);
  return {thrown_away_, common};
}

int run_with_crew(const std::string& program, int argc, char** argv,
                  const std::function<void(CrewOfProgram&)>& work) {
  CrewOfProgram crew{argc, argv};
  try {
    work(crew);
    return 0;
  } catch (const HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program, error.what());
    crew.fail();
    return 2;
  }
}

} // namespace scree::examples
