// Signals: half-written files go, and a run that asks for it may end in good order.
#include "apps/interrupt.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <functional>
#include <memory>
#include <vector>

#include "apps/output.h"
#include "apps/program.h"
#include "tests/command.h"

namespace apps {
namespace {

// Another process that does `body`. The two take turns by bytes in a pair of sockets, so that no clock decides.
class Child {
public:
    explicit Child(const std::function<void(Child&)>& body) {
        if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends_) != 0) std::abort();
        pid_ = tests::fork_child();
        close(ends_[pid_ == 0 ? 0 : 1]);
        end_ = ends_[pid_ == 0 ? 1 : 0];
        if (pid_ != 0) return;
        body(*this);
        _exit(0);
    }
    ~Child() {
        close(end_);
        if (pid_ > 0) static_cast<void>(wait());
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    void say(char word) const { EXPECT_EQ(send(end_, &word, 1, MSG_NOSIGNAL), 1); }
    char hear() const { return tests::read_byte(end_).value_or('\0'); }
    void signal(int number) const { kill(pid_, number); }
    int wait() { return tests::wait_for(std::exchange(pid_, -1)); }

private:
    int ends_[2], end_;
    pid_t pid_;
};

TEST(Interrupt, ASignalThatEndsTheProgramRemovesItsHalfWrittenFiles) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT}) {
        const tests::Directory directory;
        std::ofstream(directory / "old") << "old";
        Child child([&](Child& self) {
            watch_signals();
            OutputFile fresh(directory / "new"), old(directory / "old");
            fresh.stream() << std::string(200'000, 'x') << std::flush;
            self.say('o');
            self.hear();
        });
        ASSERT_EQ(child.hear(), 'o');
        EXPECT_EQ(directory.names().size(), 3u) << "two temporary files and the older one";
        child.signal(number);
        EXPECT_EQ(child.wait(), 128 + number);
        EXPECT_EQ(directory.names(), std::vector<std::string>{"old"});
        EXPECT_EQ(tests::read_file(directory / "old"), "old");
    }
}

// Room for the names is used again.
TEST(Interrupt, HalfWrittenFilesGoHoweverManyWereWrittenBefore) {
    constexpr int places = 32;
    const tests::Directory directory;
    Child child([&](Child& self) {
        watch_signals();
        for (int i = 0; i < 3 * places; ++i) {
            OutputFile file(directory / "whole");
            if (i % 2 == 0) file.commit();
        }
        std::vector<std::unique_ptr<OutputFile>> files;
        for (int i = 0; i < places; ++i) files.push_back(std::make_unique<OutputFile>(directory / std::to_string(i)));
        self.say('o');
        self.hear();
    });
    ASSERT_EQ(child.hear(), 'o');
    EXPECT_EQ(directory.names().size(), 1u + places);
    child.signal(SIGTERM);
    EXPECT_EQ(child.wait(), 128 + SIGTERM);
    EXPECT_EQ(directory.names(), std::vector<std::string>{"whole"});
}

TEST(Interrupt, AWholeFileIsNotRemovedByALateSignal) {
    const tests::Directory directory;
    Child child([&](Child& self) {
        watch_signals();
        OutputFile file(directory / "whole");
        file.commit();
        const OutputFile half(directory / "half");
        self.say('o');
        self.hear();
    });
    ASSERT_EQ(child.hear(), 'o');
    child.signal(SIGQUIT);
    EXPECT_EQ(child.wait(), 128 + SIGQUIT);
    EXPECT_EQ(directory.names(), std::vector<std::string>{"whole"});
}

TEST(Interrupt, ExitRemovesHalfWrittenFilesToo) {
    const tests::Directory directory;
    Child child([&](Child&) {
        watch_signals();
        const OutputFile file(directory / "new");
        std::exit(3);
    });
    EXPECT_EQ(child.wait(), 3);
    EXPECT_TRUE(directory.names().empty());
}

TEST(Interrupt, TheFirstSignalAsksAndTheSecondEnds) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        const tests::Directory directory;
        Child child([&](Child& self) {
            watch_signals();
            finish_on_signal();
            const OutputFile file(directory / "new");
            self.say(interrupted() ? 'y' : 'n');
            self.hear();
            self.say(interrupted() ? 'y' : 'n');
            self.hear();
        });
        EXPECT_EQ(child.hear(), 'n');
        child.signal(number);
        child.say('.');
        EXPECT_EQ(child.hear(), 'y');
        child.signal(number);
        EXPECT_EQ(child.wait(), 128 + number);
        EXPECT_TRUE(directory.names().empty());
    }
}

TEST(Interrupt, LeavesIgnoredSignalsIgnored) {
    Child child([](Child& self) {
        std::signal(SIGHUP, SIG_IGN);
        watch_signals();
        self.say('r');
        self.hear();
    });
    ASSERT_EQ(child.hear(), 'r');
    child.signal(SIGHUP);
    child.say('.');
    EXPECT_EQ(child.wait(), 0);
}

TEST(Interrupt, IsReportedByRunProgram) {
    const auto run = [] {
        tests::default_signals();
        CLI::App app("A test.", "program");
        char name[] = "program";
        char* arguments[] = {name, nullptr};
        std::exit(run_program(
            app, 1, arguments, [] {},
            [] {
                finish_on_signal();
                throw_if_interrupted();
                std::raise(SIGTERM);
                throw_if_interrupted();
            }));
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(exit_interrupted), "^program: interrupted\n$");
}

}  // namespace
}  // namespace apps
