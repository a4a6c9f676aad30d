// Settings, counts of calls and failures.  Nothing here is ever destroyed: threads of streams outlive main.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

#include "tests/support/simulated_cuda/simulation.hpp"

namespace slideway::simulated_cuda {

namespace {

char const* variable(char const* name) {
    char const* const text = std::getenv(name);
    return text != nullptr && *text != '\0' ? text : nullptr;
}

template <class Number> void read(char const* name, Number& number) {
    char const* const text = variable(name);
    if (text == nullptr) return;
    char* end = nullptr;
    number = static_cast<Number>(std::strtoll(text, &end, 10));
    if (*end != '\0') misuse(std::string(name) + " is " + text + ", not a number");
}

Settings read_settings() {
    Settings s;
    read("SIMULATED_CUDA_DEVICES", s.devices);
    read("SIMULATED_CUDA_ARCH", s.architecture);
    read("SIMULATED_CUDA_WATCHDOG", s.watchdog);
    read("SIMULATED_CUDA_MULTIPROCESSORS", s.multiprocessors);
    read("SIMULATED_CUDA_MEMORY", s.memory);
    read("SIMULATED_CUDA_DELAY", s.delay);
    if (char const* const path = variable("SIMULATED_CUDA_COUNTS")) s.counts = path;
    s.tells_leaks = std::string_view(variable("SIMULATED_CUDA_LEAKS") ? variable("SIMULATED_CUDA_LEAKS") : "") == "1";
    return s;
}

struct Failure {
    std::string function;
    std::uint64_t at = 0;
    cudaError_t code = cudaErrorUnknown;
};

Failure read_failure() {
    Failure f;
    char const* const text = variable("SIMULATED_CUDA_FAIL");
    if (text == nullptr) return f;
    std::string_view const all = text;
    std::size_t const colon = all.find(':');
    char* end = nullptr;
    if (colon != all.npos) {
        f.function = all.substr(0, colon);
        f.at = std::strtoull(text + colon + 1, &end, 10);
        if (*end == ':') f.code = static_cast<cudaError_t>(std::strtol(end + 1, &end, 10));
    }
    if (f.at == 0 || *end != '\0' || f.code == cudaSuccess) {
        misuse("SIMULATED_CUDA_FAIL is " + std::string(text) + ", not <function>:<n>[:<code>]");
    }
    return f;
}

struct Counts {
    std::mutex mutex;
    std::map<std::string, std::uint64_t, std::less<>> calls;
};

Counts& counts() {
    static auto& c = *new Counts;
    return c;
}

std::atomic<cudaError_t> lost = cudaSuccess;
thread_local cudaError_t last_error = cudaSuccess;

struct NamedError {
    cudaError_t code;
    char const *name, *text;
};

#define SLIDEWAY_NAMED(code) code, #code
constexpr NamedError named_errors[] = {
    {SLIDEWAY_NAMED(cudaSuccess), "no error"},
    {SLIDEWAY_NAMED(cudaErrorInvalidValue), "an argument is out of range"},
    {SLIDEWAY_NAMED(cudaErrorMemoryAllocation), "out of memory"},
    {SLIDEWAY_NAMED(cudaErrorInvalidConfiguration), "no grid can have this shape"},
    {SLIDEWAY_NAMED(cudaErrorInsufficientDriver), "the driver is too old for the runtime"},
    {SLIDEWAY_NAMED(cudaErrorInvalidDeviceFunction), "no such kernel"},
    {SLIDEWAY_NAMED(cudaErrorNoDevice), "no card was found"},
    {SLIDEWAY_NAMED(cudaErrorInvalidDevice), "no card has this number"},
    {SLIDEWAY_NAMED(cudaErrorNoKernelImageForDevice), "no machine code for this card"},
    {SLIDEWAY_NAMED(cudaErrorECCUncorrectable), "broken memory"},
    {SLIDEWAY_NAMED(cudaErrorInvalidResourceHandle), "the handle is of another card"},
    {SLIDEWAY_NAMED(cudaErrorNotReady), "not done yet"},
    {SLIDEWAY_NAMED(cudaErrorIllegalAddress), "illegal address"},
    {SLIDEWAY_NAMED(cudaErrorLaunchOutOfResources), "too many registers for a block"},
    {SLIDEWAY_NAMED(cudaErrorLaunchFailure), "the kernel failed"},
    {SLIDEWAY_NAMED(cudaErrorUnknown), "unknown error"},
};
#undef SLIDEWAY_NAMED

NamedError named(cudaError_t code) {
    for (NamedError const& e : named_errors) {
        if (e.code == code) return e;
    }
    return {code, "cudaErrorWithoutName", "an error that the simulation has no words for"};
}

// Run after the destructors of all static objects, which may still call the runtime.
__attribute__((destructor)) void tell() {
    if (settings().tells_leaks) tell_memory_leaks(), tell_stream_leaks();
    if (settings().counts.empty()) return;
    std::lock_guard const lock(counts().mutex);
    std::ofstream file(settings().counts);
    for (auto const& [function, calls] : counts().calls) file << function << ' ' << calls << '\n';
}

}  // namespace

Settings const& settings() {
    static auto const& s = *new Settings(read_settings());
    return s;
}

void misuse(std::string const& what) {
    std::fprintf(stderr, "simulated CUDA: %s\n", what.c_str());
    std::abort();
}

cudaError_t count(char const* function) {
    static auto const& failure = *new Failure(read_failure());
    std::lock_guard const lock(counts().mutex);
    return ++counts().calls[function] == failure.at && function == failure.function ? failure.code : cudaSuccess;
}

cudaError_t card_error() {
    if (settings().devices < 0) return cudaErrorInsufficientDriver;
    return settings().devices == 0 ? cudaErrorNoDevice : lost.load();
}

void lose_card(cudaError_t code) {
    cudaError_t none = cudaSuccess;
    lost.compare_exchange_strong(none, code);  // the first error is the one that is told
}

cudaError_t keep(cudaError_t code) {
    if (code != cudaSuccess) last_error = code;
    return code;
}

}  // namespace slideway::simulated_cuda

using namespace slideway::simulated_cuda;

cudaError_t cudaPeekAtLastError() {
    cudaError_t const told = count("cudaPeekAtLastError"), card = card_error();
    return told != cudaSuccess ? told : card != cudaSuccess ? card : last_error;
}

cudaError_t cudaGetLastError() {
    cudaError_t const told = count("cudaGetLastError"), card = card_error();
    cudaError_t const last = std::exchange(last_error, cudaSuccess);
    return told != cudaSuccess ? told : card != cudaSuccess ? card : last;
}

char const* cudaGetErrorName(cudaError_t code) { return named(code).name; }

char const* cudaGetErrorString(cudaError_t code) { return named(code).text; }
