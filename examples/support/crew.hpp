#pragma once
/// \file
/// The processes that `mpirun` started a program in.

#include "scree/laboratory/campaign.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace scree::examples {

/// Where a program's processes write to.
struct CrewFolders {
  std::filesystem::path
      own; ///< of this process: the results, or of all but the first one that is thrown away
  std::filesystem::path common; ///< the results, the same for all
};

/// All processes of this run, as long as it lives. Where scree was built without SCREE_MPI, or the program
/// was not started by `mpirun`, there is this one only. All but the first say nothing on standard output and
/// write no results.
class CrewOfProgram {
public:
  CrewOfProgram(int& argc, char**& argv);
  CrewOfProgram(const CrewOfProgram&) = delete;
  CrewOfProgram& operator=(const CrewOfProgram&) = delete;
  ~CrewOfProgram();

  [[nodiscard]] const Crew& crew() const { return crew_; }
  [[nodiscard]] bool first() const { return crew_.rank == 0; }

  /// `results_folder`, or with `resume` the folder `wanted` as it is, from the first process.
  /// \throws Error as `results_folder` does, or where there is nothing to resume.
  [[nodiscard]] CrewFolders folders(const std::string& wanted, const std::string& name, bool resume);

  /// To be called after an error: ends the other processes too, which wait for this one otherwise. Returns
  /// where there are none.
  void fail() const;

private:
  Crew crew_;
  std::filesystem::path thrown_away_;
};

/// The main() of a program whose processes work together: an error is told with the program's name, and ends
/// all of them.
/// \return what the program ends with: 0, or 2 after an error
int run_with_crew(const std::string& program, int argc, char** argv,
                  const std::function<void(CrewOfProgram&)>& work);

} // namespace scree::examples
