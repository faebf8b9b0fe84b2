// Signals: half-written files go, and a run that asks for it may end in good order.
#include "apps/interrupt.h"

#include <gtest/gtest.h>

#include <functional>

#include "apps/output.h"
#include "apps/program.h"
#include "tests/command.h"

namespace apps {
namespace {

// Another process that does `body`. The two take turns by bytes in pipes, so that no clock decides.
class Child {
public:
    explicit Child(const std::function<void(Child&)>& body) {
        if (pipe(up_) != 0 || pipe(down_) != 0) std::abort();
        pid_ = fork();
        if (pid_ != 0) return;
        std::swap(up_[0], down_[0]);
        std::swap(up_[1], down_[1]);
        body(*this);
        _exit(0);
    }
    ~Child() {
        for (const int descriptor : {up_[0], up_[1], down_[0], down_[1]}) close(descriptor);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    void say(char word) const { ASSERT_EQ(write(down_[1], &word, 1), 1); }
    char hear() const {
        char word = 0;
        return read(up_[0], &word, 1) == 1 ? word : '\0';
    }
    void signal(int number) const { kill(pid_, number); }
    int wait() const {
        int status = 0;
        waitpid(pid_, &status, 0);
        return tests::code_of(status);
    }

private:
    int up_[2], down_[2];  // to the parent, to the child; the child has them the other way round
    pid_t pid_;
};

TEST(Interrupt, ASignalThatEndsTheProgramRemovesItsHalfWrittenFiles) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        const tests::Directory directory;
        std::ofstream(directory / "old") << "old";
        const Child child([&](Child& self) {
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

TEST(Interrupt, ExitRemovesHalfWrittenFilesToo) {
    const tests::Directory directory;
    const Child child([&](Child&) {
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
        const Child child([&](Child& self) {
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
    const Child child([](Child& self) {
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
