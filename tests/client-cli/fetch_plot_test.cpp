#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>

#include "case_file/case_source.h"
#include "fake_server.h"
#include "program.h"
#include "synthetic_crush.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

Script finished_script() {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.samples = synthetic_samples(400, 0.8);
  for (const double strain : {0.0, 0.2, 0.4, 0.8}) script.stages.push_back(synthetic_stage(20, 6, strain));
  script.stages[2].frame.set_index(20);
  script.result = "CELLCRUSH RESULT 1 3895751574 123456\n" + std::string(123456, 'r');
  return script;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

ProgramResult fetch(const FakeServer& server, const fs::path& folder, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"fetch", "test", "-o", folder});
  return server.run(more);
}

std::ptrdiff_t file_count(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(Fetch, WritesResultHistoryCaseAndFrame) {
  const FakeServer server(finished_script());
  const fs::path folder = server.folder() / "new" / "run";
  const std::string time = std::to_string(finished_script().stages[2].frame.time_s() * 1.05);
  const ProgramResult result = fetch(server, folder, {"--frame", time});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(text_of_file(folder / "result.h5"), finished_script().result);
  const std::string history = text_of_file(folder / "history.csv");
  EXPECT_EQ(first_line(history).find(
                "time_s,travel_mm,strain,stress_impact_mpa,stress_support_mpa,energy_kinetic_mj,energy_elastic_mj,"
                "energy_plastic_mj,energy_contact_mj,energy_friction_mj,energy_damping_mj,work_external_mj,"
                "energy_residual_mj"),
            0U);
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 401);
  EXPECT_EQ(parse_text_case(text_of_file(folder / "case.txtpb"), "case").title(), "Type I of the tests");
  const std::string frame = text_of_file(folder / "frame_0020.csv");
  EXPECT_EQ(std::count(frame.begin(), frame.end(), '\n'), 1 + finished_script().stages[2].mesh.thickness_mm_size());
  EXPECT_EQ(file_count(folder), 4);
}

TEST(Fetch, AgainOverwritesItsOwnFilesAlsoOfEarlierVersionsAndNoOthers) {
  const FakeServer server(finished_script());
  const fs::path folder = server.folder() / "run";
  ASSERT_EQ(fetch(server, folder).exit_code, 0);
  std::ofstream(folder / "result.h5") << "\x89HDF\r\n\x1a\n and more";
  std::ofstream(folder / "history.csv") << "time_s,travel_mm,strain,stress_impact_mpa\n0,0,0,0\n";
  EXPECT_EQ(fetch(server, folder).exit_code, 0);
  EXPECT_EQ(text_of_file(folder / "result.h5"), finished_script().result);
  std::ofstream(folder / "history.csv") << "my own notes\n";
  const ProgramResult refused = fetch(server, folder);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("history.csv: exists and was not written by cellcrush"));
  EXPECT_EQ(text_of_file(folder / "history.csv"), "my own notes\n");
  fs::remove(folder / "history.csv");
  fs::create_directory(folder / "history.csv");
  EXPECT_EQ(fetch(server, folder).exit_code, 2) << "a folder is in the way";
}

TEST(Fetch, ACutDownloadGoesOnWhereItStopped) {
  Script script = finished_script();
  script.cut_downloads = 1;
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  EXPECT_EQ(fetch(server, folder).exit_code, 0);
  EXPECT_EQ(text_of_file(folder / "result.h5"), script.result);
  const auto half = static_cast<std::int64_t>(script.result.size() / 2);
  EXPECT_EQ(server.asked().offsets, (std::vector<std::int64_t>{0, half}));
  script.cut_downloads = 1000;
  const FakeServer other(script);
  const ProgramResult cut = fetch(other, other.folder() / "run");
  EXPECT_EQ(cut.exit_code, 4);
  EXPECT_THAT(cut.errors, HasSubstr("broke off at byte " + std::to_string(half)));
  EXPECT_EQ(file_count(other.folder() / "run"), 1) << "the part, for the next fetch";
}

TEST(Fetch, ContinuesWhatAnEarlierCommandLeftIfItIsOfThisFile) {
  const Script script = finished_script();
  const auto part = [&](const FakeServer& server, const std::string& bytes) {
    fs::create_directory(server.folder() / "run");
    std::ofstream(server.folder() / "run" / "result.h5.part") << bytes;
    EXPECT_EQ(fetch(server, server.folder() / "run").exit_code, 0);
    EXPECT_EQ(text_of_file(server.folder() / "run" / "result.h5"), script.result);
    EXPECT_FALSE(fs::exists(server.folder() / "run" / "result.h5.part"));
    return server.asked().offsets;
  };
  using Offsets = std::vector<std::int64_t>;
  EXPECT_EQ(part(FakeServer(script), script.result.substr(0, 1500)), (Offsets{1500}));
  std::string other = script.result.substr(0, 1500);
  other.back() ^= 1;
  EXPECT_EQ(part(FakeServer(script), other), (Offsets{1500, 0}));
}

TEST(Fetch, BytesThatChangedOnTheWayAreRefused) {
  Script script = finished_script();
  script.damages_downloads = true;
  const FakeServer server(script);
  const ProgramResult result = fetch(server, server.folder() / "run");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.errors, HasSubstr("result.h5 was damaged on its way"));
  EXPECT_FALSE(fs::exists(server.folder() / "run"));
}

TEST(Fetch, AFullDiskLeavesTheFolderAsItWas) {
  Script script = finished_script();
  script.samples.resize(9);
  script.result = "CELLCRUSH RESULT 1 and little more";
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  fs::create_directory(folder);
  std::ofstream(folder / "result.h5") << "CELLCRUSH RESULT 1 of before";
  // The history is longer than files may be, and short enough to be written as a whole at its end.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  Program program({"fetch", "test", "-o", folder, "--server", server.address()});
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, former);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("history.csv: cannot be written"));
  EXPECT_EQ(text_of_file(folder / "result.h5"), "CELLCRUSH RESULT 1 of before");
  EXPECT_EQ(file_count(folder), 1);
}

TEST(Fetch, RemovesTheFramesAndNodesThatItWroteForAnotherJob) {
  Script script = finished_script();
  script.samples.resize(1);
  script.samples[0].add_watched()->set_node("tip");
  fs::path folder;
  {
    const FakeServer other(script);
    folder = fs::temp_directory_path() / ("cellcrush-fetch-" + other.folder().filename().string());
    ASSERT_EQ(fetch(other, folder, {"--frame", "0"}).exit_code, 0);
    ASSERT_EQ(fetch(other, folder).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "frame_0000.csv")) << "the same job's";
  }
  std::ofstream(folder / "frame_mine.csv") << "my own notes\n";
  script.samples[0].clear_watched();
  script.job.mutable_case_()->set_depth_mm(7.0);
  const FakeServer server(script);
  const ProgramResult result = fetch(server, folder);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("frame_0000.csv  removed (of an earlier fetch)\n"));
  EXPECT_FALSE(fs::exists(folder / "frame_0000.csv"));
  EXPECT_FALSE(fs::exists(folder / "nodes.csv"));
  EXPECT_TRUE(fs::exists(folder / "frame_mine.csv"));
  fs::remove_all(folder);
}

TEST(Fetch, AJobWithoutAResultIsRefused) {
  Script script = finished_script();
  script.result.clear();
  const FakeServer server(script);
  const ProgramResult result = fetch(server, server.folder() / "out" / "run");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("the job has no result yet"));
  EXPECT_FALSE(fs::exists(server.folder() / "out")) << "no empty folder is left";
}

TEST(Fetch, AVtkSeriesReplacesAnEarlierLongerOne) {
  Script script = finished_script();
  for (std::size_t i = 0; i < script.stages.size(); ++i) script.stages[i].frame.set_index(static_cast<int>(i));
  const FakeServer longer(script);
  const fs::path folder = longer.folder() / "out";
  ASSERT_EQ(fetch(longer, folder, {"--vtk"}).exit_code, 0);
  fs::copy(folder / "frame_0003.vtp", folder / "mine.vtp");
  ASSERT_EQ(fetch(longer, folder).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "frame_0003.vtp")) << "the series is still named";
  script.stages.resize(2);
  const FakeServer server(script);
  const ProgramResult result = fetch(server, folder, {"--vtk"});
  EXPECT_THAT(result.output, HasSubstr("frame_0003.vtp  removed"));
  EXPECT_FALSE(fs::exists(folder / "frame_0002.vtp"));
  EXPECT_TRUE(fs::exists(folder / "mine.vtp"));
  ASSERT_EQ(fetch(server, folder, {"--vtu"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "frame_0000.vtp"));
  script.job.mutable_case_()->set_depth_mm(7.0);
  const FakeServer other(script);
  const ProgramResult replaced = fetch(other, folder, {"--vtk", "--frame", "0"});
  EXPECT_EQ(replaced.exit_code, 0) << replaced.errors;
  EXPECT_FALSE(fs::exists(folder / "frame_0000.vtu"));
  EXPECT_TRUE(fs::exists(folder / "frame_0000.vtp"));
}

TEST(Fetch, WritesTheWatchedNodesAndRigidWallsOfSamplesThatHaveAny) {
  Script script = finished_script();
  script.samples.clear();
  for (const double time : {0.001, 0.002}) {
    script.samples.push_back(from_text<v1::Sample>(
        R"(watched { node: "tip" ux_mm: 0.1 uy_mm: -0.25 rotation_rad: 1e-3
                     reaction_x_n: 4 reaction_y_n: -5 reaction_moment_n_mm: 6.5 }
           watched { node: "a,b" ux_mm: 0.1 }
           rigid_walls { wall: "floor" displacement_mm: 0.5 normal_force_n: 12.25 tangential_force_n: -3 })"));
    script.samples.back().set_time_s(time);
  }
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  ASSERT_EQ(fetch(server, folder).exit_code, 0);
  EXPECT_EQ(text_of_file(folder / "nodes.csv"),
            "time_s,node,ux_mm,uy_mm,rotation_rad,reaction_x_n,reaction_y_n,reaction_moment_n_mm\n"
            "0.001,tip,0.1,-0.25,0.001,4,-5,6.5\n0.001,\"a,b\",0.1,0,0,0,0,0\n"
            "0.002,tip,0.1,-0.25,0.001,4,-5,6.5\n0.002,\"a,b\",0.1,0,0,0,0,0\n");
  EXPECT_EQ(text_of_file(folder / "rigid_walls.csv"),
            "time_s,wall,displacement_mm,normal_force_n,tangential_force_n,velocity_m_per_s,acceleration_m_per_s2,"
            "impulse_n_s,work_mj\n"
            "0.001,floor,0.5,12.25,-3,0,0,0,0\n0.002,floor,0.5,12.25,-3,0,0,0,0\n");
}

TEST(Plot, AJobsPngHasTheRightSize) {
  const FakeServer server(finished_script());
  const std::string file = (server.folder() / "a.png").string();
  const ProgramResult result = server.run({"plot", "jobs/test", "-o", file});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, file + "\n");
  EXPECT_EQ(text_of_file(file).substr(0, 8), "\x89PNG\r\n\x1a\n");
  // Width stands behind the signature and the name of the first chunk.
  EXPECT_EQ(text_of_file(file).substr(16, 4), std::string("\0\0\x07\xd0", 4));
  EXPECT_GT(text_of_file(file).size(), 50'000U);
}

TEST(Plot, OneFrameCanBeChosenSvgWrittenAndSeveralJobsShareAChart) {
  const FakeServer server(finished_script());
  const std::string one = (server.folder() / "one.svg").string();
  const std::string three = (server.folder() / "three.svg").string();
  EXPECT_EQ(server.run({"plot", "test", "-o", one, "--frame-strain", "0.41"}).exit_code, 0);
  EXPECT_EQ(server.run({"plot", "test", "-o", three}).exit_code, 0);
  EXPECT_EQ(server.run({"plot", "test", "jobs/test", "-o", server.folder() / "both.PNG"}).exit_code, 0);
  EXPECT_THAT(text_of_file(one), HasSubstr("</svg>"));
  EXPECT_GT(text_of_file(three).size(), text_of_file(one).size());
  ASSERT_EQ(server.run({"plot", "test", "-o", one, "--width", "3.5in", "--font", "8pt"}).exit_code, 0);
  EXPECT_THAT(text_of_file(one), HasSubstr("width=\"88.9mm\""));
}

TEST(Plot, AStripShowsFramesEvenlySpacedOverTheRunWithOrWithoutTheCurve) {
  Script script = finished_script();
  for (std::size_t i = 0; i < script.stages.size(); ++i) script.stages[i].frame.set_index(static_cast<int>(i));
  const FakeServer server(script);
  const std::string file = (server.folder() / "strip.svg").string();
  ASSERT_EQ(server.run({"plot", "test", "--strip", "3", "-o", file}).exit_code, 0);
  const std::string whole = text_of_file(file);
  const ProgramResult frames = server.run({"plot", "test", "--strip", "3", "--frames-only", "-o", file});
  ASSERT_EQ(frames.exit_code, 0) << frames.errors;
  EXPECT_LT(text_of_file(file).size(), whole.size());
  ASSERT_EQ(server.run({"plot", "test", "--strip", "2", "--frames-only", "-o", file}).exit_code, 0);
  const std::string two = text_of_file(file);
  ASSERT_EQ(server.run({"plot", "test", "--strip", "50", "--frames-only", "-o", file}).exit_code, 0);
  EXPECT_GT(2 * text_of_file(file).size(), 3 * two.size());
  EXPECT_LT(text_of_file(file).size(), 3 * two.size()) << "a frame is shown once, however many are asked for";
}

TEST(Movie, KeepsEveryFrameAsAPngOfOneSizeAndSaysWhatToDoWithoutFfmpeg) {
  Script script = finished_script();
  for (std::size_t i = 0; i < script.stages.size(); ++i) script.stages[i].frame.set_index(static_cast<int>(i));
  const FakeServer server(script);
  const fs::path folder = server.folder() / "frames";
  const ProgramResult result = server.run({"movie", "test", "--frames", folder});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, folder.string() + "  4 frames\n");
  // Width and height stand behind the signature and the name of the first chunk.
  const std::string json = server.run({"movie", "test", "--frames", folder, "--json"}).output;
  EXPECT_TRUE(json.starts_with('{') && json.ends_with("}\n")) << json;
  EXPECT_THAT(json, HasSubstr("\"path\":\"" + folder.string() + '"'));
  EXPECT_THAT(json, HasSubstr("\"frame_count\":4"));
  const std::string size = text_of_file(folder / "frame_00000.png").substr(16, 8);
  EXPECT_EQ((size[3] | size[7]) & 1, 0) << "video encoders want even numbers of pixels";
  for (const char* name : {"frame_00001.png", "frame_00002.png", "frame_00003.png"}) {
    EXPECT_EQ(text_of_file(folder / name).substr(16, 8), size) << name;
  }
  script.stages.resize(2);
  const FakeServer shorter(script);
  ASSERT_EQ(shorter.run({"movie", "test", "--frames", folder}).exit_code, 0);
  EXPECT_EQ(file_count(folder), 2);
  EXPECT_THAT(shorter.run({"movie", "test", "-o", "a.avi"}).errors, HasSubstr("ends in .mp4, .webm or .gif"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.c_str(), 1);
  const ProgramResult refused = server.run({"movie", "test", "-o", server.folder() / "a.mp4"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("apt-get install ffmpeg"));
  EXPECT_EQ(server.run({"movie", "test"}).exit_code, 2);
}

TEST(Plot, OptionsThatDoNotGoTogetherAreRefused) {
  const FakeServer server(finished_script());
  const std::string file = (server.folder() / "a.png").string();
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"test", "test", "--strip", "3"},
                                             {"test", "--strip", "3", "--frame-strain", "0.2"},
                                             {"test", "--strip", "0"},
                                             {"sweeps/1", "test"},
                                             {"test", "--log", "x"},
                                             {"test", "--series"},
                                             {"test", "--window", "0.1,0.2"},
                                             {"sweeps/1", "--with", "test.csv"},
                                             {"test", "--with", "test.csv", "--wide"},
                                             {"test", "--width", "85mm"},
                                             {"test", "--width", "85", "-o", "a.svg"},
                                             {"sweeps/1", "--frames-only"}}) {
    std::vector<std::string> arguments = {"plot"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    arguments.insert(arguments.end(), {"-o", file});
    EXPECT_EQ(server.run(arguments).exit_code, 2) << words[0] << words[1];
  }
  EXPECT_FALSE(fs::exists(file));
}

// Of a test that has nine tenths of the stress.
v1::CompareTestResponse nine_tenths(bool is_force) {
  v1::CompareTestResponse out;
  out.set_is_force(is_force);
  out.set_to(0.5);
  out.set_window_low(0.2);
  out.set_window_high(0.4);
  out.set_energy_to(0.5);
  out.mutable_measured()->set_mean(0.9);
  out.mutable_computed()->set_mean(1.0);
  out.mutable_measured()->set_energy(0.45);
  out.mutable_computed()->set_energy(0.5);
  for (const double at : {0.0, 0.5}) {
    out.add_x(at);
    out.add_measured_mean(0.9);
    out.add_measured_least(0.8);
    out.add_measured_most(1.0);
    out.add_computed_y(1.0);
  }
  return out;
}

TEST(Plot, ATestIsComparedWithTheCurveOfAJob) {
  Script script = finished_script();
  script.difference = nine_tenths(false);
  const FakeServer server(script);
  const fs::path test = server.folder() / "test.csv";
  std::ofstream(test) << "Weg / mm;Kraft / N\n0;0\n1;2\n2;3\n";
  const fs::path picture = server.folder() / "a.svg";
  const ProgramResult result = server.run({"plot", "test", "--with", test, "-o", picture});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("elastic slope, MPa                         -         -           -"));
  EXPECT_THAT(result.output, HasSubstr("mean from 0.2 to 0.4, MPa              0.900      1.00     +11.1 %"));
  EXPECT_THAT(text_of_file(picture), HasSubstr("svg"));
  EXPECT_THAT(server.asked().compared.tests(0).text(), HasSubstr("Kraft"));
  const ProgramResult json = server.run(
      {"plot", "test", "--with", test, "--window", "0.1,0.3", "--energy-to", "0.4", "-o", picture, "--json"});
  EXPECT_THAT(json.output, HasSubstr("\"window_high\":0.4"));
  EXPECT_DOUBLE_EQ(server.asked().compared.window_high(), 0.3);
  EXPECT_DOUBLE_EQ(server.asked().compared.energy_to(), 0.4);
  const ProgramResult refused = server.run({"plot", "test", "--with", test, "--window", "0.3", "-o", picture});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("--window 0.2,0.4"));
  EXPECT_EQ(server.run({"plot", "test", "--with", server.folder() / "missing.csv", "-o", picture}).exit_code, 2);
  EXPECT_EQ(server.run({"plot", "test", "--force", "press", "-o", picture}).exit_code, 2);
}

TEST(Plot, ATestIsComparedWithTheForceOfAPart) {
  Script script = finished_script();
  script.difference = nine_tenths(true);
  const FakeServer server(script);
  const fs::path test = server.folder() / "test.csv";
  std::ofstream(test) << "Weg / mm;Kraft / N\n0;0\n1;2\n2;3\n";
  const fs::path picture = server.folder() / "a.svg";
  const ProgramResult result = server.run({"plot", "test", "--with", test, "--with", test, "--force", "left.y+right.y",
                                           "--displacement", "top.y", "-o", picture});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("mean from 0.2 to 0.4 mm, N"));
  EXPECT_THAT(result.output, HasSubstr("energy to 0.5 mm, mJ"));
  EXPECT_EQ(server.asked().compared.force_part(), "left.y+right.y");
  EXPECT_EQ(server.asked().compared.displacement_part(), "top.y");
  EXPECT_EQ(server.asked().compared.tests_size(), 2);
  EXPECT_THAT(text_of_file(picture), HasSubstr("svg"));
}

TEST(Plot, AJobWithoutSamplesAndAnUnknownFormatAreRefused) {
  Script script = finished_script();
  script.samples.clear();
  const FakeServer server(script);
  EXPECT_EQ(server.run({"plot", "test", "-o", server.folder() / "a.png"}).exit_code, 2);
  EXPECT_EQ(server.run({"plot", "test", "-o", server.folder() / "a.gif"}).exit_code, 2);
}

TEST(SweepPlot, IsDrawnAsPngAndSvg) {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.sweeps = make_sweep_script({v1::Job::SUCCEEDED, v1::Job::SUCCEEDED, v1::Job::SUCCEEDED, v1::Job::FAILED});
  const FakeServer server(script);
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    const std::string file = (server.folder() / name).string();
    const ProgramResult result = server.run({"plot", "sweeps/test", "sweeps/test", "--log", "xy", "-o", file});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.output, file + "\n");
    EXPECT_GT(text_of_file(file).size(), 5000U);
  }
  EXPECT_EQ(text_of_file(server.folder() / "a.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(text_of_file(server.folder() / "a.svg"), HasSubstr("</svg>"));
}

TEST(SweepPlot, WithoutAPlateauIsRefusedAndAnUnknownSweepNotFound) {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.sweeps = make_sweep_script({v1::Job::CANCELLED, v1::Job::FAILED});
  const FakeServer server(script);
  const std::string file = (server.folder() / "a.png").string();
  const ProgramResult refused = server.run({"plot", "sweeps/test", "sweeps/test", "--log", "xy", "-o", file});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("with a plateau yet"));
  EXPECT_EQ(server.run({"plot", "sweeps/none", "-o", file}).exit_code, 5);
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace cellcrush::client::testing
