// posectl as a user runs it: what it prints, and its exit codes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>

#include "played_daemon.h"

namespace posed::client {
namespace {

using namespace test;  // NOLINT: the vocabulary of these tests
using Lines = std::vector<std::string>;

struct Outcome {
  int code = -1;
  std::string out, err;
};

Outcome posectl(const std::string& arguments, const std::string& before = "") {
  std::string errors = ::testing::TempDir() + "posectl-errors-XXXXXX";
  const int fd = mkstemp(errors.data());
  ::close(fd);
  // Whose edits these are is kept where no other run of the tests finds it.
  static const std::string kState =
      "XDG_STATE_HOME=" + ::testing::TempDir() + "posectl-" + std::to_string(getpid()) + ' ';
  FILE* pipe = popen((before + ' ' + kState + POSED_PROGRAMS "/posectl " + arguments + " 2>" + errors).c_str(), "r");
  Outcome run;
  char chunk[4096];
  while (const std::size_t got = fread(chunk, 1, sizeof chunk, pipe)) run.out.append(chunk, got);
  const int status = pclose(pipe);
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  FILE* file = fopen(errors.c_str(), "r");
  while (const std::size_t got = fread(chunk, 1, sizeof chunk, file)) run.err.append(chunk, got);
  fclose(file);
  std::remove(errors.c_str());
  return run;
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

// Answers everything that posectl asks.
Lines answer(const proto::Request& request) {
  const auto* params = &request.params;
  if (std::get_if<proto::SessionStatus>(params)) {
    proto::StatusResult status;
    status.daemon = {"posed", "0.1.0"};
    status.t_ns = 1'500'000'000;
    status.revision = 7;
    status.figures = {"body"};
    status.goals = 3;
    status.method = "reach_tree";
    return reply(request, status);
  }
  if (const auto* wish = std::get_if<proto::StreamSubscribe>(params)) {
    Lines lines = reply(request, proto::SubscribeResult{wish->stream});
    for (std::uint64_t seq = 1; seq <= 5; ++seq) {
      proto::FigurePose figure;
      figure.figure = "body";
      proto::GoalFrame goal;
      goal.id = "g1";
      goal.state = GoalState::balanced;
      goal.error = 0.0341;
      figure.goals = {goal};
      figure.world_from_segment = {{{0.1, -0.2, 1.0}, quat_identity()}};
      proto::PoseData data;
      data.t_ns = static_cast<Nanoseconds>(seq) * 1'000'000'000;
      data.revision = 9;
      data.figures = {figure};
      lines.push_back(proto::encode_pose_frame(seq, data, {}) + "\n");
    }
    return lines;
  }
  if (std::get_if<proto::StreamAck>(params)) return {};
  if (std::get_if<proto::SessionHello>(params)) return reply(request, proto::HelloResult{});
  if (std::get_if<proto::SessionPing>(params)) return reply(request, proto::PingResult{1, 2});
  if (std::get_if<proto::FigureGet>(params)) {
    proto::FigureResult figure;
    figure.entry.template_name = "tempus";
    figure.document.segments.resize(1);
    figure.document.segments[0].name = "hips";
    return reply(request, figure);
  }
  if (const auto* set = std::get_if<proto::GoalSet>(params)) {
    return reply(request, proto::EditResult{set->edit.id.empty() ? "made" : set->edit.id, 8, 1});
  }
  if (std::get_if<proto::GoalRemove>(params)) {
    return {proto::encode_error(request.id, {"unknown_goal", "no goal is called x", "/params/id", "did you mean g1?"}) +
            "\n"};
  }
  if (std::get_if<proto::GoalList>(params)) {
    proto::GoalListResult list;
    list.goals.resize(2);
    list.goals[0].goal.id = "g1";
    list.goals[0].goal.figure = "body";
    list.goals[0].goal.at = {"right_hand", {}, "fingertip"};
    list.goals[0].goal.payload = PositionTarget{{0.5, -0.3, 1.2}};
    list.goals[1].goal.id = "look";
    list.goals[1].goal.figure = "body";
    list.goals[1].goal.at = {"head", {}, ""};
    list.goals[1].goal.payload = AimTarget{{1, 0, 0}, Vec3(2, 0, 1), {}};
    list.goals[1].goal.relative_to = {GoalBase::Kind::sensor, "", "", "liberty:1"};
    list.goals[1].goal.priority = -1;
    return reply(request, list);
  }
  if (std::get_if<proto::GoalClear>(params)) return reply(request, proto::ClearResult{3, 9});
  if (std::get_if<proto::PoseGet>(params)) {
    proto::PoseResult pose;
    pose.pose.figure = "body";
    pose.method = "reach_tree";
    return reply(request, pose);
  }
  if (std::get_if<proto::TrackerList>(params)) {
    return reply(request,
                 proto::TrackerListResult{{{"simulated", "simulated", "streaming", "", 240.0, 9, 0, {"simulated:1"}}}});
  }
  if (std::get_if<proto::SceneList>(params)) return reply(request, proto::SceneListResult{{"monday"}, {"standing"}});
  if (std::get_if<proto::SceneSave>(params)) return reply(request, proto::EmptyResult{});
  return reply(request, proto::RevisionResult{10});
}

class Posectl : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return posectl("--host " + daemon.address() + " " + arguments); }
  std::string last_line() const { return daemon.lines().back(); }
  // What was said behind the hello.
  std::string first_line() const { return daemon.lines().at(1); }
  PlayedDaemon daemon{answer};
};

TEST_F(Posectl, Status) {
  const Outcome text = run("status");
  EXPECT_EQ(text.code, 0);
  EXPECT_TRUE(has(text.out, "posed 0.1.0, up 1.5 s, revision 7")) << text.out;
  EXPECT_EQ(text.err, "");
  const Outcome json = run("status --json");
  EXPECT_EQ(json.code, 0);
  EXPECT_TRUE(json.out.starts_with("{") && has(json.out, "\"revision\":7")) << json.out;
}

TEST_F(Posectl, WatchStopsAfterTheCount) {
  const Outcome text = run("watch pose --count 3 --rate 30 --figure body");
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'), 3);
  EXPECT_TRUE(text.out.starts_with("t 1.000 s  revision 9  body converged  g1 balanced 34.1 mm\n")) << text.out;
  EXPECT_TRUE(has(first_line(), "\"max_rate_hz\":30")) << first_line();
  EXPECT_TRUE(has(first_line(), "\"figures\":[\"body\"]"));
  const Outcome json = run("--json watch --count 1");
  EXPECT_EQ(json.code, 0);
  EXPECT_TRUE(json.out.starts_with("{") && has(json.out, "\"t_ns\":1000000000")) << json.out;
}

TEST_F(Posectl, WatchesAsRowsAndAsATable) {
  const Outcome csv = run("watch pose --csv --count 2");
  EXPECT_EQ(csv.code, 0) << csv.err;
  EXPECT_EQ(csv.out,
            "t_ns,revision,figure,segment,x,y,z,qx,qy,qz,qw\n"
            "1000000000,9,body,hips,0.100000,-0.200000,1.000000,0.0000000,0.0000000,0.0000000,1.0000000\n"
            "2000000000,9,body,hips,0.100000,-0.200000,1.000000,0.0000000,0.0000000,0.0000000,1.0000000\n");
  const Outcome table = run("watch pose --table --count 2");
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_TRUE(has(table.out, "body  converged") && has(table.out, "balanced") && has(table.out, "34.1")) << table.out;
  EXPECT_TRUE(has(table.out, "age ") && has(table.out, "left out 0")) << table.out;
  EXPECT_EQ(run("watch scene --csv").code, 2);
  EXPECT_EQ(run("watch --csv --table").code, 2);
}

TEST_F(Posectl, ErrorsMayBeJsonToo) {
  const Outcome refused = run("--json goal remove x");
  EXPECT_EQ(refused.code, 1);
  EXPECT_TRUE(has(refused.err, R"("code":"unknown_goal")") && has(refused.err, R"("path":"/params/id")"))
      << refused.err;
}

TEST_F(Posectl, ATokenIsSaidFirst) {
  ASSERT_EQ(run("--token secret status").code, 0);
  EXPECT_TRUE(has(daemon.lines().front(), "session.hello") && has(daemon.lines().front(), R"("token":"secret")"))
      << daemon.lines().front();
}

TEST(PosectlAlone, TokensAreMadeAndNeverTheSame) {
  const Outcome one = posectl("token editor ana"), other = posectl("token editor ana");
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_TRUE(one.out.starts_with("editor ana sha256:")) << one.out;
  EXPECT_EQ(one.out.size(), std::string("editor ana sha256:\n").size() + 64);
  EXPECT_NE(one.out, other.out);
  EXPECT_TRUE(has(one.err, "the token of ana")) << one.err;
  EXPECT_EQ(posectl("token king ana").code, 2);
  EXPECT_EQ(posectl("token editor 'a b'").code, 2);
}

TEST(PosectlAlone, AShellCompletesItsWords) {
  const std::string source = "source <(" POSED_PROGRAMS "/posectl completion bash); ";
  const auto completed = [&](const std::string& words) {
    const Outcome done = posectl("completion bash >/dev/null; bash -c '" + source + "COMP_WORDS=(" + words +
                                 "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _posectl; echo ${COMPREPLY[*]}'");
    return done.out;
  };
  EXPECT_TRUE(has(completed("posectl st"), "status")) << completed("posectl st");
  EXPECT_TRUE(has(completed("posectl goal se"), "set"));
  EXPECT_TRUE(has(completed("posectl watch tr"), "tracker"));
  EXPECT_TRUE(has(completed("posectl figure pin left_foot or"), "orientation"));
  EXPECT_EQ(completed("posectl goal set h --compare at_"), "at_least at_most\n");
  EXPECT_TRUE(has(completed("posectl hi"), "history"));
  EXPECT_TRUE(has(completed("posectl watch pose --c"), "--count --csv")) << completed("posectl watch pose --c");
}

TEST_F(Posectl, SaysWhoItIsAndIsTheSameEditorEachTime) {
  ASSERT_EQ(run("--user ana status").code, 0);
  ASSERT_EQ(run("--user ana status").code, 0);
  const Lines lines = daemon.lines();
  const auto resume = [&](std::size_t i) { return lines[i].substr(lines[i].find("\"resume\":"), 45); };
  EXPECT_TRUE(has(lines[0], R"("name":"posectl")") && has(lines[0], R"("user":"ana")")) << lines[0];
  EXPECT_EQ(resume(0), resume(2));
  EXPECT_EQ(resume(0).size(), std::string(R"("resume":"0123456789abcdef0123456789abcdef")").size() + 2) << resume(0);
}

TEST_F(Posectl, AnEditorWithNoPlaceToKeepItsKeyStillWorks) {
  EXPECT_EQ(posectl("--host " + daemon.address() + " status", "HOME=/dev/null XDG_STATE_HOME=/dev/null").code, 0);
}

TEST_F(Posectl, GoalsOfEveryKindHaveOptions) {
  const auto sends = [&](const std::string& words, std::string_view part) {
    const Outcome done = run("goal set " + words);
    EXPECT_EQ(done.code, 0) << words << ": " << done.err;
    EXPECT_TRUE(has(last_line(), part)) << last_line();
  };
  sends("head --orientation 0 0 0 1", R"("orientation":{"quat_xyzw":[0.0,0.0,0.0,1.0]})");
  sends("right_hand 1 2 3 --orientation 0 0 0 1", R"("position":[1.0,2.0,3.0])");
  sends("head/eyes --aim 2 0.5 1 --axis 0 1 0", R"("aim":{"axis":[0.0,1.0,0.0],"point":[2.0,0.5,1.0]})");
  sends("head/eyes --along 0 0 -1", R"("direction":[0.0,0.0,-1.0])");
  sends("left_hand --plane 0 0 0.75 --above", R"("normal":[0.0,0.0,1.0],"side":"above")");
  sends("left_hand --line 0 0 1 --direction 0 1 0", R"("line":{"point":[0.0,0.0,1.0],"direction":[0.0,1.0,0.0]})");
  sends("left_hand --distance-to right_hand --length 0.3 --compare at_least", R"("compare":"at_least")");
  sends("--balance left_foot right_foot --margin 0.02",
        R"("balance":{"support":["left_foot","right_foot"],"margin":0.02})");
  sends("--posture rest --weight 0.5", R"("posture":{"pose":"rest"})");
  sends("--id g1 --weight 4 --off", R"("enabled":false)");
  sends("right_hand 0 0 0 --relative-to object:chair --priority -1 --tolerance 0.01",
        R"("relative_to":{"object":"chair"})");
  sends("right_hand 0 0 0 --relative-to segment:ana/head", R"("relative_to":{"figure":"ana","segment":"head"})");
  sends("right_hand 0 0 0 --relative-to sensor:liberty:1", R"("relative_to":{"sensor":"liberty:1"})");
  for (const char* words : {"right_hand", "", "right_hand 1 2", "right_hand 0 0 0 --relative-to chair", "h --margin 1",
                            "h --line 0 0 0", "h --distance-to x", "h --aim 0 0 0 --along 0 0 1", "--id g --on --off"})
    EXPECT_EQ(run(std::string("goal set ") + words).code, 2) << words;
}

TEST_F(Posectl, Goals) {
  const Outcome set = run("goal set right_hand/fingertip 0.5 -0.3 1.2 --weight 40 --id g1 --figure body");
  EXPECT_EQ(set.code, 0) << set.err;
  EXPECT_EQ(set.out, "g1 is set (revision 8)\n");
  EXPECT_TRUE(has(last_line(), R"("at":"right_hand/fingertip")")) << last_line();
  EXPECT_TRUE(has(last_line(), "[0.5,-0.3,1.2]") && has(last_line(), "\"weight\":40")) << last_line();
  EXPECT_EQ(run("goal set head 0 0 -1.5").code, 0);
  EXPECT_FALSE(has(last_line(), "weight")) << "what is not named is not sent";
  EXPECT_TRUE(has(run("goal list").out, "g1  body at right_hand/fingertip  [0.5 -0.3 1.2] m  weight 10"));
  EXPECT_TRUE(has(run("goal list").out, "look  body at head  aim from liberty:1  weight 10  priority -1\n"));
  EXPECT_EQ(run("goal clear").out, "3 goals are removed (revision 9)\n");
}

TEST_F(Posectl, GoalsOfEveryKindAreSetAsJson) {
  const Outcome set = run(R"(goal set '{"at":"head","aim":{"axis":[1,0,0],"point":[2,0,1]}}')");
  EXPECT_EQ(set.code, 0) << set.err;
  EXPECT_TRUE(has(set.out, " is set (revision 8)\n")) << set.out;
  EXPECT_TRUE(has(last_line(), R"("aim":{"axis":[1,0,0],"point":[2,0,1]})")) << last_line();
  EXPECT_EQ(run("goal set '{}' --weight 3").code, 2);
}

TEST_F(Posectl, ARefusalIsExplained) {
  const Outcome refused = run("goal remove x");
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(refused.out, "");
  EXPECT_TRUE(has(refused.err, "no goal is called x (at /params/id)")) << refused.err;
  EXPECT_TRUE(has(refused.err, "did you mean g1?"));
}

TEST_F(Posectl, PosesTrackersAndScenes) {
  for (const char* words :
       {"pose get", "pose get --figure body", "pose reset", "pose reset start", "pose mirror", "tracker",
        "tracker list", "scene list", "scene new paper/sitting", "scene save monday", "scene open monday"}) {
    const Outcome done = run(words);
    EXPECT_EQ(done.code, 0) << words << ": " << done.err;
    EXPECT_NE(done.out, "") << words;
  }
  EXPECT_TRUE(has(run("tracker").out, "simulated  streaming  240 Hz  9 frames"));
}

TEST_F(Posectl, CallsAnyMethod) {
  EXPECT_TRUE(has(run("call session.status").out, "\"revision\": 7"));
  EXPECT_EQ(run("--json call goal.clear '{\"figure\":\"body\"}'").out, "{\"removed\":3,\"revision\":9}\n");
  EXPECT_TRUE(has(last_line(), "\"figure\":\"body\""));
  const Outcome piped = posectl("--host " + daemon.address() + " call goal.clear -", "echo '{\"figure\":\"piped\"}' |");
  EXPECT_EQ(piped.code, 0) << piped.err;
  EXPECT_TRUE(has(last_line(), "\"figure\":\"piped\""));
  EXPECT_EQ(run("call goal.clear '{'").code, 1);
}

TEST_F(Posectl, TheHostMayComeFromTheEnvironment) {
  EXPECT_EQ(posectl("status", "POSED_HOST=" + daemon.address()).code, 0);
}

TEST(PosectlAlone, AMistypedWordIsGuessed) {
  EXPECT_TRUE(has(posectl("stauts").err, "has no command stauts\nposectl: did you mean status?"))
      << posectl("stauts").err;
  EXPECT_TRUE(has(posectl("goal lst").err, "posectl goal has no command lst\nposectl: did you mean list?"));
  EXPECT_TRUE(has(posectl("edit undo").err, "did you mean posectl undo?")) << posectl("edit undo").err;
  EXPECT_TRUE(has(posectl("goal set h 0 0 0 --wieght 3").err, "did you mean --weight?"))
      << posectl("goal set h 0 0 0 --wieght 3").err;
  const Outcome json = posectl("--json stauts");
  EXPECT_EQ(json.code, 2);
  EXPECT_TRUE(has(json.err, R"("code":"bad_usage")")) << json.err;
}

TEST(PosectlAlone, HelpAndTheManualAreMadeOfOneTable) {
  const Outcome help = posectl("help goal set"), same = posectl("goal set --help");
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.out, same.out);
  EXPECT_TRUE(has(help.out, "--relative-to") && has(help.out, "Example:")) << help.out;
  EXPECT_TRUE(has(posectl("help").out, "watch"));
  EXPECT_TRUE(has(posectl("help goal st").err, "did you mean set?"));
  const Outcome man = posectl("help --man");
  EXPECT_EQ(man.code, 0);
  for (const char* part :
       {".TH POSECTL 1", ".SS posectl goal set", ".SS posectl undo", "\\-\\-relative\\-to", "EXIT STATUS"})
    EXPECT_TRUE(has(man.out, part)) << part;
}

TEST(PosectlAlone, WrongUsageIsTwo) {
  for (const char* words : {"", "nonsense", "goal", "goal set right_hand 1 2", "watch nothing", "watch --count x",
                            "--host", "--host ws://x status", "pose reset sideways", "scene new"}) {
    const Outcome wrong = posectl(words);
    EXPECT_EQ(wrong.code, 2) << words;
    EXPECT_NE(wrong.err, "") << words;
  }
  const Outcome help = posectl("--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_TRUE(has(help.out, "watch"));
}

TEST(PosectlAlone, NoDaemonIsThree) {
  const Outcome alone = posectl("--host " + nobody() + " status");
  EXPECT_EQ(alone.code, 3);
  EXPECT_TRUE(has(alone.err, "nothing listens at 127.0.0.1:")) << alone.err;
  EXPECT_TRUE(has(alone.err, "./deploy/run"));
}

TEST(PosectlAlone, ALostConnectionIsThree) {
  PlayedDaemon daemon([](const proto::Request&) { return Lines{"close"}; });
  EXPECT_EQ(posectl("--host " + daemon.address() + " watch").code, 3);
}

}  // namespace
}  // namespace posed::client
