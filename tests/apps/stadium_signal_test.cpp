// The stadium when it is told to stop. Pipes in place of files hold it where the test wants it: no clock decides.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/command.h"

namespace {

const std::string stadium = std::string(GRANDSTAND_BIN) + "/stadium";
const char* endless = "10000000";  // frames

class StadiumSignals : public testing::Test {
protected:
    void SetUp() override { std::signal(SIGPIPE, SIG_IGN); }  // a program that ended is seen as such
    void TearDown() override { std::signal(SIGPIPE, SIG_DFL); }

    std::vector<std::string> with(const std::vector<std::string>& more) const {
        std::vector<std::string> command = {stadium, "--headless", "--people",  "200",     "--size",
                                            "96x54", "--frames",   endless,     "--trace", trace_,
                                            "--png", picture_,     "--summary", summary_};
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }

    // A place that the program waits at until the test opens the other end.
    std::string make_pipe(const std::string& name) const {
        const std::string path = directory_ / name;
        EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
        return path;
    }

    // The test's end of a pipe whose other end the program reads, or has written to; -1: it ended before.
    static int meet_reader(const tests::Process& process, const std::string& path) {
        int descriptor = -1;
        process.until([&] { return (descriptor = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)) >= 0; });
        return descriptor;
    }
    static int meet_writer(const tests::Process& process, const std::string& path) {
        pollfd pipe{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC), POLLIN, 0};
        if (process.until([&] { return poll(&pipe, 1, 0) > 0; })) return pipe.fd;
        close(pipe.fd);
        return -1;
    }

    // Reads to the end, so that the program can go on.
    static void drain(int descriptor) {
        while (tests::read_byte(descriptor)) {
        }
        close(descriptor);
    }

    tests::Directory directory_;
    std::string trace_ = directory_ / "t.csv", picture_ = directory_ / "p.png", summary_ = directory_ / "s.json";
};

TEST_F(StadiumSignals, ARunThatIsInterruptedKeepsWhatItHas) {
    const std::string first_picture = make_pipe("frame000000.png");
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        tests::Process process(with({"--png-every", endless, "--png-dir", directory_ / "."}));
        const int drawn = meet_writer(process, first_picture);  // the first frame
        ASSERT_GE(drawn, 0) << "it ended before a frame was drawn: " << process.wait();
        process.signal(number);
        drain(drawn);
        EXPECT_EQ(process.wait(), 0);
        EXPECT_EQ(directory_.names(), (std::vector<std::string>{"frame000000.png", "p.png", "s.json", "t.csv"}));
        EXPECT_TRUE(tests::read_file(trace_).ends_with("\n"));
        EXPECT_TRUE(tests::read_file(picture_).starts_with("\x89PNG"));
        EXPECT_TRUE(tests::read_file(summary_).ends_with("}\n"));
        for (const std::string& file : {trace_, picture_, summary_}) std::filesystem::remove(file);
    }
}

TEST_F(StadiumSignals, ASetUpThatIsInterruptedLeavesNothing) {
    const std::string camera = make_pipe("camera.json");
    tests::Process process(with({"--camera", camera}));
    const int keys = meet_reader(process, camera);
    ASSERT_GE(keys, 0) << "it ended before it read its camera: " << process.wait();
    process.signal(SIGINT);
    const std::string text = R"({"keys":[{"time_s":0,"position":[0,9,0],"target":[9,9,0],"fov_deg":50}]})";
    EXPECT_EQ(write(keys, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    close(keys);
    EXPECT_EQ(process.wait(), 130);
    EXPECT_EQ(directory_.names(), std::vector<std::string>{"camera.json"});
}

TEST_F(StadiumSignals, ASetUpThatIsKilledLeavesNothing) {
    const std::string camera = make_pipe("camera.json");
    tests::Process process(with({"--camera", camera}));
    const int waiting = meet_reader(process, camera);
    ASSERT_GE(waiting, 0) << "it ended before it read its camera: " << process.wait();
    EXPECT_EQ(directory_.names().size(), 4u) << "the outputs are open";
    process.signal(SIGPIPE);  // ends it at once
    EXPECT_EQ(process.wait(), 128 + SIGPIPE);
    close(waiting);
    EXPECT_EQ(directory_.names(), std::vector<std::string>{"camera.json"});
}

}  // namespace
