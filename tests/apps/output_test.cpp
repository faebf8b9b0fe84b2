// Files that are whole or not there, and which of the files on a command line are one.
#include "apps/output.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>
#include <stdexcept>
#include <vector>

#include "apps/places.h"
#include "tests/apps/failing_calls.h"
#include "tests/command.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

class Output : public testing::Test {
protected:
    std::string put(const std::string& name, const std::string& text) const {
        std::ofstream(directory_ / name) << text;
        return directory_ / name;
    }
    std::string text(const std::string& name) const { return tests::read_file(directory_ / name); }

    // What opening, writing `content` and committing says; empty: it succeeded.
    static std::string complaint(const std::string& path, const std::string& content = "new") {
        try {
            OutputFile file(path);
            file.stream() << content;
            file.commit();
            return {};
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    }

    tests::Directory directory_;
};

// Root may write what is read-only; the effective user is somebody else while this lives.
class Nobody {
public:
    Nobody() : me_(geteuid()) { changed_ = me_ != 0 || seteuid(65534) == 0; }
    ~Nobody() {
        if (me_ == 0 && seteuid(me_) != 0) std::abort();
    }
    bool changed() const { return changed_; }

private:
    uid_t me_;
    bool changed_ = false;
};

TEST_F(Output, IsNotThereBeforeCommitAndWholeAfter) {
    OutputFile file(directory_ / "a");
    file.stream() << "text";
    EXPECT_FALSE(fs::exists(directory_ / "a"));
    file.commit();
    EXPECT_EQ(text("a"), "text");
    EXPECT_EQ(directory_.names(), std::vector<std::string>{"a"});
}

// Bytes that tell their place.
std::string numbered(std::size_t size) {
    std::string text;
    for (int i = 0; text.size() < size; ++i) text += std::to_string(i) + ' ';
    return text.substr(0, size);
}

TEST_F(Output, HoldsMoreThanItsBuffer) {
    constexpr std::size_t buffer = 1 << 16;
    for (const std::size_t size : {buffer - 1, buffer, buffer + 1, 2 * buffer, std::size_t{1'000'003}}) {
        const std::string large = numbered(size);
        EXPECT_EQ(complaint(directory_ / "at once", large), "");
        EXPECT_TRUE(text("at once") == large) << size;
        OutputFile file(directory_ / "by bytes");
        for (const char c : large) file.stream().put(c);
        file.commit();
        EXPECT_TRUE(text("by bytes") == large) << size;
    }
}

TEST_F(Output, WhatIsFlushedIsWritten) {
    const std::string pipe = directory_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    OutputFile file(pipe);
    file.stream() << "ab" << std::flush;
    char bytes[3];
    EXPECT_EQ(read(reader, bytes, sizeof bytes), 2);
    file.stream() << "c";
    EXPECT_EQ(read(reader, bytes, sizeof bytes), -1) << "not flushed yet";
    file.commit();
    EXPECT_EQ(read(reader, bytes, sizeof bytes), 1);
    EXPECT_EQ(read(reader, bytes, sizeof bytes), 0) << "closed";
    close(reader);
}

// --- System calls that fail.

TEST_F(Output, AnInterruptedWriteIsTakenUpAgain) {
    const std::string large = numbered(300'000);
    tests::FailingCalls calls;
    calls.write_errors = {EINTR, 0, EINTR, EINTR, EINTR, 0};
    EXPECT_EQ(complaint(directory_ / "a", large), "");
    EXPECT_TRUE(text("a") == large);
}

TEST_F(Output, AWriteThatTakesAPartIsContinued) {
    const std::string large = numbered(200'001);
    for (const std::size_t part : {std::size_t{1}, std::size_t{999}, std::size_t{65'535}}) {
        tests::FailingCalls calls;
        calls.longest_write = part;
        EXPECT_EQ(complaint(directory_ / "a", large), "") << part;
        EXPECT_TRUE(text("a") == large) << part;
    }
}

// Some file systems find only then that there is no room.
TEST_F(Output, AFailingCloseIsAFailedFile) {
    put("old", "old");
    tests::FailingCalls calls;
    calls.close_error = EDQUOT;
    for (const char* name : {"new", "old"}) {
        EXPECT_EQ(complaint(directory_ / name), "cannot write " + (directory_ / name) + ": " + std::strerror(EDQUOT));
    }
    EXPECT_EQ(directory_.names(), std::vector<std::string>{"old"});
    EXPECT_EQ(text("old"), "old");
}

TEST_F(Output, TheFirstFailureIsTheOneThatIsTold) {
    put("old", "old");
    for (const std::size_t size : {10u, 500'000u}) {
        tests::FailingCalls calls;
        calls.write_errors = {ENOSPC, EIO};
        calls.close_error = EDQUOT;
        EXPECT_EQ(complaint(directory_ / "old", numbered(size)),
                  "cannot write " + (directory_ / "old") + ": " + std::strerror(ENOSPC));
        EXPECT_EQ(calls.written.size(), 1u) << "nothing is written behind a gap";
    }
    EXPECT_EQ(directory_.names(), std::vector<std::string>{"old"});
    EXPECT_EQ(text("old"), "old");
}

TEST_F(Output, AFileThatCannotTakeItsPlaceLeavesTheOlderOne) {
    put("old", "old");
    tests::FailingCalls calls;
    calls.rename_error = EXDEV;
    EXPECT_EQ(complaint(directory_ / "old"), "cannot write " + (directory_ / "old") + ": " + std::strerror(EXDEV));
    EXPECT_EQ(directory_.names(), std::vector<std::string>{"old"});
    EXPECT_EQ(text("old"), "old");
}

// A number closed twice may be another file's by then.
TEST_F(Output, EveryDescriptorIsClosedOnceAndStandardOutputNever) {
    for (const bool is_kept : {true, false}) {
        tests::FailingCalls calls;
        {
            OutputFile file(directory_ / "a");
            file.stream() << "text";
            if (is_kept) file.commit();
        }
        EXPECT_EQ(calls.closed.size(), 1u) << (is_kept ? "committed" : "given up");
        if (is_kept) {
            EXPECT_EQ(calls.closed, calls.written);
        }
    }
    tests::FailingCalls calls;
    {
        OutputFile file("-");
        file.commit();
    }
    EXPECT_TRUE(calls.closed.empty());
}

TEST_F(Output, AFileOverTheLimitOfSizesIsRefusedWithItsReason) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100'000, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string said = complaint(directory_ / "a", numbered(150'000));
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(said, "cannot write " + (directory_ / "a") + ": " + std::strerror(EFBIG));
    EXPECT_TRUE(directory_.names().empty());
}

TEST_F(Output, ANewFileHasTheModeThatTheUsersMaskLeaves) {
    for (const mode_t mask : {022, 027, 077, 0}) {
        const mode_t before = umask(mask);
        const std::string name = directory_ / ("a" + std::to_string(mask));
        EXPECT_EQ(complaint(name), "");
        umask(before);
        EXPECT_EQ(fs::status(name).permissions(), fs::perms(0666 & ~mask)) << std::oct << mask;
    }
}

TEST_F(Output, LeavesNothingAfterAThrow) {
    put("old", "old");
    try {
        OutputFile fresh(directory_ / "new"), old(directory_ / "old");
        old.stream() << "half";
        throw std::runtime_error("the run fails");
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(directory_.names(), std::vector<std::string>{"old"});
    EXPECT_EQ(text("old"), "old");
}

TEST_F(Output, TwoOfOnePathDoNotMixTheirBytes) {
    OutputFile first(directory_ / "a"), second(directory_ / "a");
    EXPECT_EQ(directory_.names().size(), 2u);
    first.stream() << "first";
    second.stream() << "second";
    first.commit();
    EXPECT_EQ(text("a"), "first");
    second.commit();
    EXPECT_EQ(text("a"), "second");
}

TEST_F(Output, SaysWhyAWriteFailed) {
    EXPECT_EQ(complaint("/dev/full"), "cannot write /dev/full: No space left on device");
    EXPECT_EQ(complaint("/dev/full", std::string(1'000'000, 'x')), "cannot write /dev/full: No space left on device");
}

TEST_F(Output, RefusesWhatIsNoPlaceForAFile) {
    const std::string file = put("file", "");
    EXPECT_NE(complaint(directory_ / ".").find("found a directory"), std::string::npos);
    EXPECT_NE(complaint(directory_ / "no/such/place").find("No such file or directory"), std::string::npos);
    EXPECT_NE(complaint(file + "/below").find("Not a directory"), std::string::npos);
    EXPECT_NE(complaint("").find("found no name"), std::string::npos);
    fs::create_symlink("loop", directory_ / "loop");
    EXPECT_NE(complaint(directory_ / "loop").find("symbolic links"), std::string::npos);
}

TEST_F(Output, FollowsLinksAlsoThoseThatLeadToNothingYet) {
    put("old", "old");
    fs::create_symlink("old", directory_ / "to_old");
    fs::create_symlink("to_old", directory_ / "twice");
    fs::create_symlink("fresh", directory_ / "to_fresh");
    EXPECT_EQ(complaint(directory_ / "twice"), "");
    EXPECT_EQ(complaint(directory_ / "to_fresh"), "");
    for (const char* link : {"to_old", "twice", "to_fresh"}) EXPECT_TRUE(fs::is_symlink(directory_ / link)) << link;
    EXPECT_EQ(text("old"), "new");
    EXPECT_EQ(text("fresh"), "new");
}

TEST_F(Output, KeepsTheModeOfTheOlderFile) {
    const std::string path = put("old", "old");
    for (const fs::perms mode : {fs::perms(0600), fs::perms(0666), fs::perms(0751)}) {
        fs::permissions(path, mode);
        const mode_t before = umask(077);  // it is for new files
        EXPECT_EQ(complaint(path), "");
        umask(before);
        EXPECT_EQ(fs::status(path).permissions(), mode);
    }
}

TEST_F(Output, DoesNotReplaceAReadOnlyFile) {
    const std::string path = put("old", "old");
    fs::permissions(path, fs::perms(0444));
    fs::permissions(directory_ / ".", fs::perms::all);  // the file's own mode forbids it, not the folder's
    {
        const Nobody nobody;
        if (!nobody.changed()) GTEST_SKIP() << "NOTHING IS TESTED HERE: root can't become somebody else";
        EXPECT_NE(complaint(path).find("Permission denied"), std::string::npos);
    }
    EXPECT_EQ(text("old"), "old");
}

// A program that was killed may have left one of the same name, and processes' numbers come again.
TEST_F(Output, LeavesHalfWrittenFilesOfOthersAlone) {
    constexpr int most_files = 500;  // more than this program opens
    const std::string path = directory_ / "a", left = "a.part" + std::to_string(getpid()) + "-";
    for (int i = 0; i < most_files; ++i) put(left + std::to_string(i), "left");
    EXPECT_EQ(complaint(path), "");
    EXPECT_EQ(text("a"), "new");
    for (int i = 0; i < most_files; ++i) EXPECT_EQ(text(left + std::to_string(i)), "left") << i;
}

TEST_F(Output, SameFileWhateverItIsCalled) {
    const std::string file = put("file", "");
    fs::create_symlink("file", directory_ / "link");
    fs::create_symlink("fresh", directory_ / "to_fresh");
    EXPECT_TRUE(same_file(file, directory_ / "./file"));
    EXPECT_TRUE(same_file(file, directory_ / "link"));
    EXPECT_TRUE(same_file(directory_ / "fresh", directory_ / "to_fresh"));
    EXPECT_TRUE(same_file("no_such_file", "./no_such_file"));
    EXPECT_FALSE(same_file(file, directory_ / "fresh"));
    EXPECT_FALSE(same_file(directory_ / "fresh", directory_ / "fresher"));
    EXPECT_FALSE(same_file("/dev/null", "/dev/null")) << "a device may be shared";
}

TEST_F(Output, RefusesPlacesThatAreOne) {
    const Place input{"--in", put("in", "")}, none{"--none", ""}, out{"--out", directory_ / "out"};
    const auto refused = [](std::vector<Place> inputs, std::vector<Place> outputs) {
        try {
            check_places(inputs, outputs);
            return std::string();
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(refused({input, none}, {out, none, none, {"--stdout", "-"}}), "");
    EXPECT_NE(refused({}, {out, {"--b", directory_ / "./out"}}).find("--out and --b"), std::string::npos);
    EXPECT_NE(refused({input}, {out, {"--b", directory_ / "./in"}}).find("--in and --b"), std::string::npos);
    EXPECT_NE(refused({}, {{"--a", "-"}, {"--b", "-"}}).find("at most one"), std::string::npos);
    EXPECT_NE(refused({}, {{"--a", directory_ / "a"}, out, {"--b", directory_ / "out"}}).find("--out and --b"),
              std::string::npos);
    EXPECT_EQ(refused({{"--in", "/dev/null"}}, {{"--a", "/dev/null"}, {"--b", "/dev/null"}}), "") << "no file at all";
}

TEST_F(Output, FollowsLinksOfLinks) {
    fs::create_symlink("b", directory_ / "a");
    fs::create_symlink("c", directory_ / "b");
    EXPECT_TRUE(same_file(directory_ / "a", directory_ / "c")) << "neither is there yet";
    EXPECT_EQ(complaint(directory_ / "a"), "");
    EXPECT_EQ(text("c"), "new");
    EXPECT_TRUE(fs::is_symlink(directory_ / "b"));
}

}  // namespace
}  // namespace apps
