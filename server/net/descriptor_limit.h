#pragma once

namespace cellcrush::net {

/// Raises the soft limit on file descriptors to the hard limit. Returns how many connections may be open, between 8 and
/// `wanted`, so that enough descriptors remain for the journal, results and `workers` jobs. Logs a warning if that is
/// fewer than wanted.
int raise_descriptor_limit(int wanted, int workers);

}  // namespace cellcrush::net
