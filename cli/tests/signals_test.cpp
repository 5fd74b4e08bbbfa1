// A signal that ends the command leaves no file that is half written; one that is ignored does not end it.

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include <catch2/catch.hpp>

#include "command.hpp"

namespace {

using namespace hts::cli::testing;

/// Exit code, as a shell says it, of a command that gets the signal while it waits for more points and writes
/// out.csv.
int exit_code_after(const Workplace& place, const std::string& signal, const std::string& before = "") {
    const std::string script = "cd '" + place.folder().string() + "' && mkfifo in && { " + before +
                               " '" HTS_COMMAND
                               "' phi --points in --output out.csv >/dev/null 2>&1 & } && "
                               "exec 3<>in && echo 'g,t' >&3 && echo 1,2 >&3 && "
                               "for i in $(seq 1000); do ls out.csv.partial-* >/dev/null 2>&1 && break; "
                               "sleep 0.01; done && kill -" +
                               signal + " $! && exec 3>&- && wait $!";
    return WEXITSTATUS(std::system(script.c_str()));
}

}  // namespace

TEST_CASE("signals: the file under construction is removed") {
    for (const auto& [signal, number] : {std::pair{"TERM", 15}, std::pair{"HUP", 1}}) {
        const Workplace place;
        CHECK(exit_code_after(place, signal) == 128 + number);
        CHECK(place.names() == std::vector<std::string>{"in"});
    }
}

TEST_CASE("signals: under nohup the command goes on after its terminal is gone") {
    const Workplace place;
    CHECK(exit_code_after(place, "HUP", "nohup") == 0);
    CHECK(place.names() == std::vector<std::string>{"in", "out.csv"});
}
