#include "studies/engine/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "studies/shell.h"

namespace flyball {
namespace {

constexpr std::string_view script = R"(#!/usr/bin/env bash
#SBATCH --job-name={name}
#SBATCH --array=1-{shards}
#SBATCH --cpus-per-task={threads}
#SBATCH --time=01:00:00
#SBATCH --requeue
#SBATCH --signal=TERM@60
#SBATCH --output=slurm-%A_%a.log

# Each job of the array runs one part of the study in a folder of its own. Submitted with
#
#   parts=$(sbatch --parsable SCRIPT)
#   sbatch --dependency=afterok:$parts SCRIPT join
#
# the second line joins the parts when all of them are done, and writes the tables. A job that was ended, by the
# system or by its time, goes on where it was when it is queued again.
set -euo pipefail
cd -- {folder}

if [[ ${{1:-}} == join ]]; then
  # This one is no part: it belongs to the first job of its own array.
  if [[ ${{SLURM_ARRAY_TASK_ID:-1}} != 1 ]]; then exit 0; fi
  {program} study merge {output} {output}/part-*
  exec {program} study {study} --output {output} --threads "${{SLURM_CPUS_PER_TASK:-1}}"
fi

part=$SLURM_ARRAY_TASK_ID
exec {program} study {study} --output {output}/part-"$part" --shard "$part/{shards}" \
  --threads "${{SLURM_CPUS_PER_TASK:-1}}" --quiet
)";

/// Of what a name may hold in a directive, which no shell reads.
std::string plain(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-'; }, '_');
  return name;
}

}  // namespace

std::string slurm_script(const SlurmJob& job) {
  return fmt::format(
      script, fmt::arg("name", plain(job.study.stem().string())), fmt::arg("shards", job.shards),
      fmt::arg("threads", job.threads), fmt::arg("folder", shell_quoted(job.folder.string())),
      fmt::arg("program", shell_quoted(job.program)), fmt::arg("output", shell_quoted(job.output.string())),
      fmt::arg("study", shell_quoted(job.study.string())));
}

}  // namespace flyball
