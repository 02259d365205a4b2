#pragma once

namespace cellcrush::net {

/// Raises this process's soft limit on file descriptors to the hard one. How many connections may be open then, at most
/// `wanted`, so that enough descriptors are left for the journal, results and `workers` jobs; the log warns when they
/// are fewer than wanted. At least 8.
int raise_descriptor_limit(int wanted, int workers);

}  // namespace cellcrush::net
