// A signal that ends the command leaves no file that is half written; one that is ignored does not end it.

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "command.hpp"

namespace {

namespace fs = std::filesystem;
using namespace hts::cli::testing;

/// Exit code of a bash script that runs in the folder.
int exit_code_of(const Workplace& place, const std::string& script) {
    place.file("../script", "cd '" + place.folder().string() + "'\n" + script + "\n");
    const std::string path = (place.folder().parent_path() / "script").string();
    return WEXITSTATUS(std::system(("bash '" + path + "'").c_str()));
}

/// The same of a command that gets the signal while it waits for more points and writes out.csv.
int exit_code_after(const Workplace& place, const std::string& signal, const std::string& before = "") {
    return exit_code_of(place, "mkfifo in && { " + before +
                                   " '" HTS_COMMAND
                                   "' phi --points in --output out.csv >/dev/null 2>&1 & } && "
                                   "exec 3<>in && echo 'g,t' >&3 && echo 1,2 >&3 && "
                                   "for i in $(seq 1000); do ls .hts-*/out.csv >/dev/null 2>&1 && break; "
                                   "sleep 0.01; done && kill -" +
                                   signal + " $! && exec 3>&- && wait $!");
}

}  // namespace

TEST_CASE("signals: the file under construction is removed") {
    for (const auto& [signal, number] :
         {std::pair{"TERM", 15}, std::pair{"HUP", 1}, std::pair{"USR1", 10}, std::pair{"XCPU", 24}}) {
        INFO(signal);
        const Workplace place;
        CHECK(exit_code_after(place, signal) == 128 + number);
        CHECK(place.names() == std::vector<std::string>{"in"});
    }
}

TEST_CASE("signals: under nohup the command goes on after its terminal is gone") {
    for (const auto& [signal, before] :
         {std::pair{"HUP", "nohup"}, std::pair{"HUP", "trap '' HUP;"}, std::pair{"TERM", "trap '' TERM;"},
          std::pair{"PIPE", "trap '' PIPE;"}}) {
        INFO(signal);
        const Workplace place;
        CHECK(exit_code_after(place, signal, before) == 0);
        CHECK(place.names() == std::vector<std::string>{"in", "out.csv"});
    }
}

TEST_CASE("signals: nothing of a picture is left, and gnuplot ends with the command") {
    for (const auto& [signal, number] : {std::pair{"INT", 2}, std::pair{"TERM", 15}, std::pair{"HUP", 1}}) {
        INFO(signal);
        const Workplace place;
        // takes its time, as gnuplot does with many points; says in a file that it has begun
        const fs::path tools = place.folder().parent_path() / "tools";
        fs::create_directory(tools);
        place.file("../tools/gnuplot", "#!/bin/sh\ntouch .picture.svg ../../../begun\nexec sleep 60\n");
        fs::permissions(tools / "gnuplot", fs::perms::owner_all);
        // with job control a command in the background does not ignore INT
        const std::string script = "set -m; PATH='" + tools.string() +
                                   "':$PATH '" HTS_COMMAND
                                   "' furnace --quick --output new >/dev/null 2>&1 &\n"
                                   "for i in $(seq 3000); do [ -e ../begun ] && break; sleep 0.01; done\n"
                                   "kill -" +
                                   std::string{signal} + " $!; wait $!";
        CHECK(exit_code_of(place, script) == 128 + number);
        CHECK(place.names().empty());
    }
}

TEST_CASE("signals: a file as large as the shell allows is an error, and leaves nothing") {
    const Workplace place;
    const std::string m = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";
    check_complaint(place.hts("sample -m " + m + " --wavelength 2 --theta-i 45 --count 1000 --output a.csv",
                              "ulimit -f 4;"),
                    1, {"a.csv: cannot be written (File too large)"});
    CHECK(place.names().empty());
}

TEST_CASE("signals: what another process left behind blocks nothing") {
    const Workplace place;
    CHECK(exit_code_of(place, "touch a.csv.partial-$$; mkdir .hts-$$; exec '" HTS_COMMAND
                              "' phi --g 1 --t 1 --output a.csv") == 0);
    CHECK(place.read("a.csv").starts_with("g,t,phi"));
}

TEST_CASE("signals: a reader that has seen enough leaves no file half written") {
    const Workplace place;
    const std::string m = HTS_SOURCE_DIR "/cli/data/rough-aluminium.json";
    static_cast<void>(place.hts(
        "sample -m " + m + " --wavelength 2 --theta-i 45 --count 500000 --plot x.svg 2> ../errors | true #"));
    CHECK(place.names().empty());
}
