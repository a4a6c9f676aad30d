// What ranks of a job tell each other, printed by rank 0 for tests/integration/ranks_test.cpp.
// ranks_program places N THREADS WANTED | abandon | texts BYTES... | failure | waiting | desertion RANK | crowded | deaf |
// machine
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <sys/resource.h>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/run/ranks.hpp"

namespace {

using namespace slideway;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    auto const seconds = [](timeval const& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Processor time by wall time of what is done, as a line; nothing if that did not take long enough to tell.
std::string load_of(char const* name, std::function<void()> const& what) {
    auto const start = Clock::now();
    double const before = processor_seconds();
    what();
    double const wall = std::chrono::duration<double>(Clock::now() - start).count();
    return wall < 1 ? std::string() : fmt::format("{} {}\n", name, (processor_seconds() - before) / wall);
}

void print_all(std::vector<std::string> const& texts) {
    for (std::string const& text : texts) std::fputs(text.c_str(), stdout);
}

/// Where every rank stands among those of its machine.
int machine(Ranks& ranks) {
    ranks.broadcast("begin");
    print_all(
        ranks.gather(fmt::format("rank {} is {} of {} here\n", ranks.rank(), ranks.local_rank(), ranks.local_count())));
    return ranks.agree(0);
}

/// Every thread of every rank takes places until none is left; rank 0 prints `place RANK FIRST COUNT` for each stretch.
int places(Ranks& ranks, std::uint64_t count, int threads, std::uint64_t wanted) {
    std::atomic<std::uint64_t> reported = 0;
    auto const queue = ranks.share(count, [&](std::uint64_t members) { reported += members; });
    std::mutex mutex;
    std::string text;
    auto const work = [&] {
        std::uint64_t finished = 0;
        for (;;) {
            std::uint64_t const before = queue->left();
            Stretch const stretch = queue->take(wanted, finished);
            finished = stretch.count;
            std::lock_guard const lock(mutex);
            if (queue->left() > before) text += "left grew\n";
            if (stretch.count == 0) return;
            text += fmt::format("place {} {} {}\n", ranks.rank(), stretch.first, stretch.count);
        }
    };
    // Others are slower to get their places, and rank 0 must not take all.
    while (ranks.rank() == 0 && ranks.count() > 1 && reported == 0) std::this_thread::sleep_for(1ms);
    std::vector<std::thread> workers;
    for (int i = 0; i < threads; ++i) workers.emplace_back(work);
    for (std::thread& worker : workers) worker.join();
    text += fmt::format("left {}\n", queue->left());
    print_all(ranks.gather(text));
    if (ranks.rank() == 0) fmt::print("reported {}\n", reported.load());
    return ranks.agree(0);
}

/// The last rank abandons a queue that nobody could empty.
int abandon(Ranks& ranks) {
    auto const queue = ranks.share(std::uint64_t{1} << 60, nullptr);
    std::uint64_t taken = 0;
    while (queue->take(1, 0).count > 0) {
        ++taken;
        if (ranks.rank() == ranks.count() - 1 && taken == 3) queue->abandon();
    }
    std::string text = fmt::format("rank {} stopped", ranks.rank());
    text += queue->left() == 0 ? "\n" : " with some left\n";
    print_all(ranks.gather(text));
    return ranks.agree(0);
}

std::string pattern(std::size_t bytes, int key) {
    std::string text(bytes, '\0');
    auto state = static_cast<std::uint32_t>(key + 1);
    for (char& byte : text) byte = static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
    return text;
}

/// Texts of a length go from rank 0 to all and from all to rank 0, and so does a code, twice over.
int texts(Ranks& ranks, std::size_t bytes) {
    if (ranks.rank() == 0) fmt::print("{} bytes\n", bytes);
    for (int const code : {7, 42}) {
        std::string const got = ranks.broadcast(ranks.rank() == 0 ? pattern(bytes, code) : std::string("mine"));
        std::string const own = pattern(bytes, 100 + ranks.rank());
        auto const gathered = ranks.gather(own);
        if (ranks.rank() == 0) {
            bool right = gathered.size() == static_cast<std::size_t>(ranks.count());
            for (int i = 0; i < ranks.count() && right; ++i)
                right = gathered[static_cast<std::size_t>(i)] == pattern(bytes, 100 + i);
            fmt::print("gathered {}\n", right ? "all" : "wrongly");
        } else if (!gathered.empty()) {
            return 1;
        }
        int const agreed = ranks.agree(ranks.rank() == 0 ? code : 99);
        print_all(ranks.gather(fmt::format("rank {} got {} and {}\n", ranks.rank(),
                                           got == pattern(bytes, code) ? "the text" : "something else", agreed)));
    }
    return 0;
}

/// The last rank fails at work: the others stop, rank 0 hears why, and all end with its code.
int failure(Ranks& ranks) {
    auto const queue = ranks.share(std::uint64_t{1} << 60, nullptr);
    std::string error;
    try {
        for (int taken = 0; queue->take(1, 0).count > 0; ++taken) {
            if (ranks.rank() == ranks.count() - 1 && taken == 5) throw FileError("disk.nc: no space left");
        }
    } catch (FileError const& caught) {
        error = caught.what();
        queue->abandon();
    }
    for (std::string const& text : ranks.gather(error)) {
        if (!text.empty()) fmt::print("heard {}\n", text);
    }
    return ranks.agree(ranks.rank() == 0 ? 4 : 0);
}

/// How busy a rank is while it waits for another: rank 0 in `gather`, the others in `agree`.
int waiting(Ranks& ranks) {
    bool const is_last = ranks.rank() == ranks.count() - 1;
    auto const queue = ranks.share(4, nullptr);
    if (is_last) std::this_thread::sleep_for(1500ms);
    std::string loads = load_of("gather", [&] { ranks.gather(""); });
    if (ranks.rank() == 0) std::this_thread::sleep_for(1500ms);
    loads += load_of("agree", [&] { ranks.agree(0); });
    print_all(ranks.gather(loads));
    return ranks.agree(0);
}

/// One rank leaves in the middle of the work, without a word to the others.
int desertion(Ranks& ranks, int who) {
    auto const queue = ranks.share(8, nullptr);
    if (ranks.rank() == who) throw std::runtime_error("left");
    while (queue->take(1, 0).count > 0) continue;
    ranks.gather("");
    return ranks.agree(0);
}

/// Ends as the program does when something is thrown between the invitation and the end of `gather`.
int end_of_failure(Ranks& ranks) {
    if (ranks.is_in_round()) {
        fmt::print(stderr, "in a round\n");
        ranks.abort(4);
    }
    return ranks.agree(5);
}

/// While it lives no thread can be started: there is no address space for its stack.
class NoMoreThreads {
public:
    NoMoreThreads() {
        getrlimit(RLIMIT_AS, &before_);
        rlimit const none{1 << 20, before_.rlim_max};
        setrlimit(RLIMIT_AS, &none);
    }
    ~NoMoreThreads() { setrlimit(RLIMIT_AS, &before_); }

private:
    rlimit before_{};
};

/// Rank 0 can start no thread that would answer the others.
int crowded(Ranks& ranks) {
    ranks.broadcast("begin");
    if (ranks.rank() > 0) {
        auto const queue = ranks.share(8, nullptr);
        while (queue->take(1, 0).count > 0) continue;
        ranks.gather("");
        return ranks.agree(0);
    }
    std::string reason;
    try {
        NoMoreThreads const none;
        auto const queue = ranks.share(8, nullptr);
    } catch (std::system_error const&) {
        return end_of_failure(ranks);
    }
    return 98;
}

/// The thread of rank 0 that answers the others fails at the first word of theirs.
int deaf(Ranks& ranks) {
    auto const queue = ranks.share(std::uint64_t{1} << 60, [](std::uint64_t) { throw std::runtime_error("deaf"); });
    try {
        while (queue->take(1, ranks.rank() > 0 ? 1 : 0).count > 0) continue;
        ranks.gather("");
    } catch (std::runtime_error const&) {
        return end_of_failure(ranks);
    }
    return ranks.agree(0);
}

int run(std::vector<std::string> const& words) {
    auto const number = [&](std::size_t i) { return std::stoull(words.at(i)); };
    auto const ranks = Ranks::join();
    if (ranks->rank() == 0) fmt::print("ranks {}\n", ranks->count());
    if (words.at(0) == "places") return places(*ranks, number(1), static_cast<int>(number(2)), number(3));
    if (words.at(0) == "abandon") return abandon(*ranks);
    if (words.at(0) == "texts") {
        int failed = 0;
        for (std::size_t i = 1; i < words.size() && failed == 0; ++i) failed = texts(*ranks, number(i));
        return failed != 0 ? failed : ranks->agree(0);
    }
    if (words.at(0) == "failure") return failure(*ranks);
    if (words.at(0) == "waiting") return waiting(*ranks);
    if (words.at(0) == "desertion") return desertion(*ranks, static_cast<int>(number(1)));
    if (words.at(0) == "crowded") return crowded(*ranks);
    if (words.at(0) == "deaf") return deaf(*ranks);
    if (words.at(0) == "machine") return machine(*ranks);
    return 99;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (SceneError const& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    } catch (std::exception const& error) {
        fmt::print(stderr, "failed: {}\n", error.what());
        return 6;
    }
}
