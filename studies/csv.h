#pragma once

#include <string>

#include "solvers/log.h"

namespace flyball {

/// A log as comma-separated values (RFC 4180, lines end in LF): a header "time,H,gamma" and a row a record,
/// time [s] first. Numbers have the shortest form that reads back to the same double. Names alone stand in
/// the header, so that any viewer shows them as they are in the model; their units belong to the metadata.
std::string to_csv(const Log& log);

}  // namespace flyball
