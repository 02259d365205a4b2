// A library to load before others: a clock that is an hour ahead, as on a node whose clock nobody has set.
#include <dlfcn.h>
#include <sys/time.h>

#include <ctime>

namespace {
constexpr time_t kAhead = 3600;
}

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) {
  using Real = int (*)(clockid_t, timespec*);
  static const auto real = reinterpret_cast<Real>(dlsym(RTLD_NEXT, "clock_gettime"));
  const int out = real(clock, now);
  if (out == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec += kAhead;
  return out;
}

int gettimeofday(timeval* now, void*) {
  timespec time{};
  const int out = clock_gettime(CLOCK_REALTIME, &time);
  now->tv_sec = time.tv_sec;
  now->tv_usec = time.tv_nsec / 1000;
  return out;
}

time_t time(time_t* out) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != nullptr) *out = now.tv_sec;
  return now.tv_sec;
}
}
