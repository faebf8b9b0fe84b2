// Files that are whole or not there, and which of the files on a command line are one.
#include "apps/output.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "apps/places.h"
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

TEST_F(Output, HoldsMoreThanItsBuffer) {
    const std::string large(1'000'003, 'x');
    EXPECT_EQ(complaint(directory_ / "a", large), "");
    EXPECT_EQ(text("a"), large);
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
        EXPECT_EQ(complaint(path), "");
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
}

}  // namespace
}  // namespace apps
