/* ----------------------------------------------------------------------
   A Kokkos tool: counts what a program with Kokkos does on its device, on any back end.

     c++ -O2 -std=c++17 -shared -fPIC kernel_counter.cpp -o kernel_counter.so
     KOKKOS_TOOLS_LIBS=$PWD/kernel_counter.so FOAM_COUNTS=counts.json lmp -k on t 2 -sf kk ...

   Kokkos calls the functions named kokkosp_... below.  When it ends, FOAM_COUNTS has, as JSON:
     kernels   launches by label, with the device they ran on
     fences    places where the host waits for the device, by label and the kernel launched last
     copies    Kokkos::deep_copy by direction, with bytes and labels ("fill" writes one value)
     memory    bytes that Kokkos has allocated, at most, in each memory space

   Counting does not slow the device down.  With FOAM_COUNTS_TIME=1 Kokkos waits before and after
   each kernel, and the seconds of each are in the file too; such a run has fences of its own.
------------------------------------------------------------------------- */

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <cxxabi.h>
#include <map>
#include <mutex>
#include <string>
#include <vector>

// the part of Kokkos' interface for tools (Kokkos_Profiling_C_Interface.h) that is used here; it
// is plain C and does not change between versions

extern "C" {
struct Kokkos_Profiling_SpaceHandle {
  char name[64];
};
struct Kokkos_Tools_ToolSettings {
  bool requires_global_fencing;
  bool padding[255];
};
}

namespace {

using Clock = std::chrono::steady_clock;

struct Event {
  std::string kind, device, label, after;
  uint64_t count = 0;
  double seconds = 0.0;
};
struct Copy {
  uint64_t count = 0, bytes = 0;
};
struct Memory {
  int64_t now = 0, most = 0;
};

std::mutex mutex;    // kernels may be launched by several threads
std::map<std::string, Event> kernels, fences;
std::map<std::string, std::map<std::string, Copy>> copies;
std::map<std::string, Memory> memory;
std::string last_kernel;

bool timing = false;
std::vector<std::pair<Event *, Clock::time_point>> running;

// Kokkos numbers devices with the kind of device in the highest byte

const char *device_name(uint32_t id)
{
  static const char *const names[] = {"Serial", "OpenMP",  "Cuda", "HIP",    "OpenMPTarget",
                                      "HPX",    "Threads", "SYCL", "OpenACC"};
  const uint32_t kind = id >> 24;
  return kind < sizeof(names) / sizeof(names[0]) ? names[kind] : "unknown";
}

// kernels without a name go by the type of their functor

std::string readable(const char *label)
{
  int status = 1;
  char *const name = abi::__cxa_demangle(label, nullptr, nullptr, &status);
  const std::string result = status == 0 && std::strchr(name, ':') ? name : label;
  std::free(name);
  return result;
}

uint64_t begin(const char *kind, const char *label, uint32_t device)
{
  const std::lock_guard<std::mutex> lock(mutex);
  const std::string name = readable(label), where = device_name(device);
  const bool fence = std::strcmp(kind, "fence") == 0;
  if (!fence) last_kernel = name;
  Event &event =
      fence ? fences[name + "@" + where + "@" + last_kernel] : kernels[name + "@" + where];
  event.kind = kind;
  event.device = where;
  event.label = name;
  event.after = last_kernel;
  event.count++;
  if (!timing) return 0;
  running.emplace_back(&event, Clock::now());
  return running.size() - 1;
}

// nested events end in reverse order

void end()
{
  if (!timing) return;
  const std::lock_guard<std::mutex> lock(mutex);
  if (running.empty()) return;
  const auto [event, start] = running.back();
  running.pop_back();
  event->seconds += std::chrono::duration<double>(Clock::now() - start).count();
}

std::string quoted(const std::string &text)
{
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + '"';
}

void write(FILE *file, const char *what, const std::map<std::string, Event> &events)
{
  std::fprintf(file, "\"%s\": [", what);
  const char *separator = "\n";
  for (const auto &[key, event] : events) {
    std::fprintf(file,
                 "%s  {\"label\": %s, \"after\": %s, \"kind\": \"%s\", \"device\": \"%s\", "
                 "\"count\": %llu, \"seconds\": %.9g}",
                 separator, quoted(event.label).c_str(), quoted(event.after).c_str(),
                 event.kind.c_str(), event.device.c_str(),
                 static_cast<unsigned long long>(event.count), event.seconds);
    separator = ",\n";
  }
  std::fprintf(file, "],\n");
}

}    // namespace

extern "C" {

void kokkosp_request_tool_settings(uint32_t, Kokkos_Tools_ToolSettings *settings)
{
  settings->requires_global_fencing = timing;
}

void kokkosp_init_library(int, uint64_t, uint32_t, void *)
{
  const char *const wanted = std::getenv("FOAM_COUNTS_TIME");
  timing = wanted && std::strcmp(wanted, "1") == 0;
}

void kokkosp_begin_parallel_for(const char *label, uint32_t device, uint64_t *id)
{
  *id = begin("for", label, device);
}
void kokkosp_end_parallel_for(uint64_t)
{
  end();
}
void kokkosp_begin_parallel_reduce(const char *label, uint32_t device, uint64_t *id)
{
  *id = begin("reduce", label, device);
}
void kokkosp_end_parallel_reduce(uint64_t)
{
  end();
}
void kokkosp_begin_parallel_scan(const char *label, uint32_t device, uint64_t *id)
{
  *id = begin("scan", label, device);
}
void kokkosp_end_parallel_scan(uint64_t)
{
  end();
}
void kokkosp_begin_fence(const char *label, uint32_t device, uint64_t *id)
{
  if (std::strstr(label, "Kokkos Profile Tool Fence")) {    // ours, when timing
    *id = UINT64_MAX;
    return;
  }
  *id = begin("fence", label, device);
}
void kokkosp_end_fence(uint64_t id)
{
  if (id != UINT64_MAX) end();
}

void kokkosp_begin_deep_copy(Kokkos_Profiling_SpaceHandle to, const char *to_label, const void *,
                             Kokkos_Profiling_SpaceHandle from, const char *from_label,
                             const void *, uint64_t bytes)
{
  const std::lock_guard<std::mutex> lock(mutex);
  const bool fill = std::strcmp(from.name, "Scalar") == 0 || std::strcmp(from_label, "Scalar") == 0;
  const std::string direction =
      fill ? std::string("fill ") + to.name : std::string(from.name) + " to " + to.name;
  Copy &copy = copies[direction][fill ? to_label : std::string(to_label) + " = " + from_label];
  copy.count++;
  copy.bytes += bytes;
}

void kokkosp_allocate_data(Kokkos_Profiling_SpaceHandle space, const char *, const void *,
                           uint64_t bytes)
{
  const std::lock_guard<std::mutex> lock(mutex);
  Memory &m = memory[space.name];
  m.now += bytes;
  m.most = std::max(m.most, m.now);
}
void kokkosp_deallocate_data(Kokkos_Profiling_SpaceHandle space, const char *, const void *,
                             uint64_t bytes)
{
  const std::lock_guard<std::mutex> lock(mutex);
  memory[space.name].now -= bytes;
}

void kokkosp_finalize_library()
{
  const char *const path = std::getenv("FOAM_COUNTS");
  FILE *const file = path ? std::fopen(path, "w") : stderr;
  if (!file) {
    std::perror(path);
    return;
  }
  std::fprintf(file, "{");
  write(file, "kernels", kernels);
  write(file, "fences", fences);
  std::fprintf(file, "\"copies\": [");
  const char *separator = "\n";
  for (const auto &[direction, labels] : copies)
    for (const auto &[label, copy] : labels) {
      std::fprintf(file, "%s  {\"direction\": %s, \"label\": %s, \"count\": %llu, \"bytes\": %llu}",
                   separator, quoted(direction).c_str(), quoted(label).c_str(),
                   static_cast<unsigned long long>(copy.count),
                   static_cast<unsigned long long>(copy.bytes));
      separator = ",\n";
    }
  std::fprintf(file, "],\n\"memory\": {");
  separator = "\n";
  for (const auto &[space, m] : memory) {
    std::fprintf(file, "%s  %s: %lld", separator, quoted(space).c_str(),
                 static_cast<long long>(m.most));
    separator = ",\n";
  }
  std::fprintf(file, "}}\n");
  if (path) std::fclose(file);
}
}
