#pragma once

#include <filesystem>
#include <string>

namespace flyball {

/// What a job script for a cluster is made from.
struct SlurmJob {
  std::filesystem::path study;   // file, as it is found from `folder`
  std::filesystem::path output;  // folder of the whole study
  std::filesystem::path folder;  // in which the commands run, absolute
  std::string program;           // flyball, as it is found there
  int shards = 16;
  int threads = 4;
};

/// A script for sbatch: an array of jobs, each of which runs one part of the study in a folder of its own.
/// Its comments tell how to submit it, so that the parts are joined when all of them are done. A job that is
/// ended and queued again goes on where it was.
std::string slurm_script(const SlurmJob& job);

}  // namespace flyball
