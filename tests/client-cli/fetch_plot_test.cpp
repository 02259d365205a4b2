#include <cairo.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>

#include "case_file/text_case.h"
#include "fake_server.h"
#include "program.h"
#include "synthetic_crush.h"

namespace cellcrush::client::testing {
namespace {

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

TEST(Fetch, WritesResultHistoryCaseAndFrame) {
  const FakeServer server(finished_script());
  const fs::path folder = server.folder() / "new" / "run";
  const std::string time = std::to_string(finished_script().stages[2].frame.time_s() * 1.05);
  const ProgramResult result =
      run_program({"fetch", "jobs/test", "-o", folder, "--frame", time, "--server", server.address()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(read_file(folder / "result.h5"), finished_script().result);
  const std::string history = read_file(folder / "history.csv");
  EXPECT_EQ(first_line(history).find(
                "time_s,travel_mm,strain,stress_impact_mpa,stress_support_mpa,energy_kinetic_mj,energy_elastic_mj,"
                "energy_plastic_mj,energy_contact_mj,energy_friction_mj,energy_damping_mj,work_external_mj,"
                "energy_residual_mj"),
            0U);
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 401);
  EXPECT_EQ(parse_text_case(read_file(folder / "case.txtpb"), "case").title(), "Type I of the tests");
  const std::string frame = read_file(folder / "frame_0020.csv");
  EXPECT_EQ(std::count(frame.begin(), frame.end(), '\n'), 1 + finished_script().stages[2].mesh.thickness_mm_size());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 4);
}

TEST(Fetch, AgainOverwritesItsOwnFilesAndNoOthers) {
  const FakeServer server(finished_script());
  const fs::path folder = server.folder() / "run";
  ASSERT_EQ(run_program({"fetch", "test", "-o", folder, "--server", server.address()}).exit_code, 0);
  EXPECT_EQ(run_program({"fetch", "test", "-o", folder, "--server", server.address()}).exit_code, 0);
  std::ofstream(folder / "history.csv") << "my own notes\n";
  const ProgramResult refused = run_program({"fetch", "test", "-o", folder, "--server", server.address()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("history.csv: exists and was not written by cellcrush"), std::string::npos)
      << refused.errors;
  EXPECT_EQ(read_file(folder / "history.csv"), "my own notes\n");
}

TEST(Fetch, ReplacesResultsAndHistoriesOfEarlierVersions) {
  const FakeServer server(finished_script());
  const fs::path folder = server.folder();
  std::ofstream(folder / "result.h5") << "\x89HDF\r\n\x1a\n and more";
  std::ofstream(folder / "history.csv") << "time_s,travel_mm,strain,stress_impact_mpa\n0,0,0,0\n";
  const ProgramResult result = run_program({"fetch", "test", "-o", folder, "--server", server.address()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(read_file(folder / "result.h5"), finished_script().result);
}

TEST(Fetch, ACutDownloadGoesOnWhereItStopped) {
  Script script = finished_script();
  script.cut_downloads = 1;
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  EXPECT_EQ(run_program({"fetch", "test", "-o", folder, "--server", server.address()}).exit_code, 0);
  EXPECT_EQ(read_file(folder / "result.h5"), script.result);
  const auto offsets = server.asked().offsets;
  ASSERT_EQ(offsets.size(), 2U);
  EXPECT_EQ(offsets[1], static_cast<std::int64_t>(script.result.size() / 2));
}

TEST(Fetch, ADownloadThatStaysCutEndsWithFourAndLeavesTheFolderAsItWas) {
  Script script = finished_script();
  script.cut_downloads = 1000;
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  EXPECT_EQ(run_program({"fetch", "test", "-o", folder, "--server", server.address()}).exit_code, 4);
  EXPECT_TRUE(fs::is_empty(folder));
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
  EXPECT_NE(result.errors.find("history.csv: cannot be written"), std::string::npos) << result.errors;
  EXPECT_EQ(read_file(folder / "result.h5"), "CELLCRUSH RESULT 1 of before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST(Fetch, RemovesTheFramesAndNodesThatItWroteForAnotherJob) {
  Script script = finished_script();
  script.samples.resize(1);
  script.samples[0].add_watched()->set_node("tip");
  fs::path folder;
  {
    const FakeServer other(script);
    folder = fs::temp_directory_path() / ("cellcrush-fetch-" + other.folder().filename().string());
    ASSERT_EQ(run_program({"fetch", "test", "-o", folder, "--frame", "0", "--server", other.address()}).exit_code, 0);
    ASSERT_EQ(run_program({"fetch", "test", "-o", folder, "--server", other.address()}).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "frame_0000.csv")) << "the same job's";
  }
  std::ofstream(folder / "frame_mine.csv") << "my own notes\n";
  script.samples[0].clear_watched();
  script.job.mutable_case_()->set_depth_mm(7.0);
  const FakeServer server(script);
  const ProgramResult result = run_program({"fetch", "test", "-o", folder, "--server", server.address()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find("frame_0000.csv  removed (from another job)\n"), std::string::npos) << result.output;
  EXPECT_FALSE(fs::exists(folder / "frame_0000.csv"));
  EXPECT_FALSE(fs::exists(folder / "nodes.csv"));
  EXPECT_TRUE(fs::exists(folder / "frame_mine.csv"));
  fs::remove_all(folder);
}

TEST(Fetch, AJobWithoutAResultIsRefused) {
  Script script = finished_script();
  script.result.clear();
  const FakeServer server(script);
  const ProgramResult result =
      run_program({"fetch", "test", "-o", server.folder() / "run", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("the job has no result yet"), std::string::npos);
}

TEST(Fetch, WritesTheWatchedNodesOfSamplesThatHaveAny) {
  Script script = finished_script();
  script.samples.resize(2);
  for (v1::Sample& sample : script.samples) {
    for (const char* id : {"tip", "a,b"}) {
      v1::WatchedNode& node = *sample.add_watched();
      node.set_node(id);
      node.set_ux_mm(0.1);
      node.set_uy_mm(-0.25);
      node.set_rotation_rad(1e-3);
      node.set_reaction_x_n(4.0);
      node.set_reaction_y_n(-5.0);
      node.set_reaction_moment_n_mm(6.5);
    }
  }
  script.samples[0].set_time_s(0.001);
  script.samples[1].set_time_s(0.002);
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  ASSERT_EQ(run_program({"fetch", "test", "-o", folder, "--server", server.address()}).exit_code, 0);
  EXPECT_EQ(read_file(folder / "nodes.csv"),
            "time_s,node,ux_mm,uy_mm,rotation_rad,reaction_x_n,reaction_y_n,reaction_moment_n_mm\n"
            "0.001,tip,0.1,-0.25,0.001,4,-5,6.5\n0.001,\"a,b\",0.1,-0.25,0.001,4,-5,6.5\n"
            "0.002,tip,0.1,-0.25,0.001,4,-5,6.5\n0.002,\"a,b\",0.1,-0.25,0.001,4,-5,6.5\n");
}

TEST(Fetch, WritesTheRigidWallsOfSamplesThatHaveAny) {
  Script script = finished_script();
  script.samples.resize(2);
  for (v1::Sample& sample : script.samples) {
    v1::RigidWallSample& wall = *sample.add_rigid_walls();
    wall.set_wall("floor");
    wall.set_displacement_mm(0.5);
    wall.set_normal_force_n(12.25);
    wall.set_tangential_force_n(-3.0);
  }
  script.samples[0].set_time_s(0.001);
  script.samples[1].set_time_s(0.002);
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  ASSERT_EQ(run_program({"fetch", "test", "-o", folder, "--server", server.address()}).exit_code, 0);
  EXPECT_EQ(read_file(folder / "rigid_walls.csv"),
            "time_s,wall,displacement_mm,normal_force_n,tangential_force_n\n"
            "0.001,floor,0.5,12.25,-3\n0.002,floor,0.5,12.25,-3\n");
}

TEST(Plot, AJobsPngHasTheRightSizeAndIsNotBlank) {
  const FakeServer server(finished_script());
  const std::string file = (server.folder() / "a.png").string();
  const ProgramResult result = run_program({"plot", "jobs/test", "-o", file, "--server", server.address()});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, file + "\n");
  EXPECT_EQ(read_file(file).substr(0, 8), "\x89PNG\r\n\x1a\n");
  cairo_surface_t* surface = cairo_image_surface_create_from_png(file.c_str());
  ASSERT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  EXPECT_EQ(cairo_image_surface_get_width(surface), 2000);
  const int height = cairo_image_surface_get_height(surface);
  EXPECT_GT(height, 1500);
  const int stride = cairo_image_surface_get_stride(surface);
  std::set<std::uint32_t> colours;
  for (int i = 0; i + 4 <= height * stride; i += 4) {
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, cairo_image_surface_get_data(surface) + i, 4);
    colours.insert(pixel & 0xFFFFFF);
  }
  EXPECT_GT(colours.size(), 500U);
  EXPECT_TRUE(colours.contains(0xFFFFFF));
  cairo_surface_destroy(surface);
}

TEST(Plot, OneFrameCanBeChosenAndSvgWritten) {
  const FakeServer server(finished_script());
  const std::string one = (server.folder() / "one.svg").string();
  const std::string three = (server.folder() / "three.svg").string();
  EXPECT_EQ(run_program({"plot", "test", "-o", one, "--frame-strain", "0.41", "--server", server.address()}).exit_code,
            0);
  EXPECT_EQ(run_program({"plot", "test", "-o", three, "--server", server.address()}).exit_code, 0);
  EXPECT_NE(read_file(one).find("</svg>"), std::string::npos);
  EXPECT_GT(read_file(three).size(), read_file(one).size());
}

TEST(Plot, AStripShowsFramesEvenlySpacedOverTheRunWithOrWithoutTheCurve) {
  Script script = finished_script();
  for (std::size_t i = 0; i < script.stages.size(); ++i) script.stages[i].frame.set_index(static_cast<int>(i));
  const FakeServer server(script);
  const std::string file = (server.folder() / "strip.svg").string();
  ASSERT_EQ(run_program({"plot", "test", "--strip", "3", "-o", file, "--server", server.address()}).exit_code, 0);
  const std::string whole = read_file(file);
  const ProgramResult frames =
      run_program({"plot", "test", "--strip", "3", "--frames-only", "-o", file, "--server", server.address()});
  ASSERT_EQ(frames.exit_code, 0) << frames.errors;
  EXPECT_LT(read_file(file).size(), whole.size());
  ASSERT_EQ(run_program({"plot", "test", "--strip", "2", "--frames-only", "-o", file, "--server", server.address()})
                .exit_code,
            0);
  const std::string two = read_file(file);
  ASSERT_EQ(run_program({"plot", "test", "--strip", "50", "--frames-only", "-o", file, "--server", server.address()})
                .exit_code,
            0);
  EXPECT_GT(2 * read_file(file).size(), 3 * two.size());
  EXPECT_LT(read_file(file).size(), 3 * two.size()) << "a frame is shown once, however many are asked for";
}

TEST(Movie, KeepsEveryFrameAsAPngOfOneSizeAndSaysWhatToDoWithoutFfmpeg) {
  Script script = finished_script();
  for (std::size_t i = 0; i < script.stages.size(); ++i) script.stages[i].frame.set_index(static_cast<int>(i));
  const FakeServer server(script);
  const fs::path folder = server.folder() / "frames";
  const ProgramResult result = run_program({"movie", "test", "--frames", folder, "--server", server.address()});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output, folder.string() + "  4 frames\n");
  // Width and height stand behind the signature and the name of the first chunk.
  const std::string json =
      run_program({"movie", "test", "--frames", folder, "--json", "--server", server.address()}).output;
  EXPECT_TRUE(json.starts_with('{') && json.ends_with("}\n")) << json;
  EXPECT_NE(json.find("\"path\":\"" + folder.string() + '"'), std::string::npos) << json;
  EXPECT_NE(json.find("\"frame_count\":4"), std::string::npos) << json;
  const std::string size = read_file(folder / "frame_00000.png").substr(16, 8);
  for (const char* name : {"frame_00001.png", "frame_00002.png", "frame_00003.png"}) {
    EXPECT_EQ(read_file(folder / name).substr(16, 8), size) << name;
  }
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.c_str(), 1);
  const ProgramResult refused =
      run_program({"movie", "test", "-o", server.folder() / "a.mp4", "--server", server.address()});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("apt-get install ffmpeg"), std::string::npos) << refused.errors;
  EXPECT_EQ(run_program({"movie", "test", "--server", server.address()}).exit_code, 2);
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
                                             {"sweeps/1", "--frames-only"}}) {
    std::vector<std::string> arguments = {"plot"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    arguments.insert(arguments.end(), {"-o", file, "--server", server.address()});
    EXPECT_EQ(run_program(arguments).exit_code, 2) << words[0] << words[1];
  }
  EXPECT_FALSE(fs::exists(file));
}

TEST(Plot, SeveralJobsShareOneChart) {
  const FakeServer server(finished_script());
  const std::string file = (server.folder() / "b.png").string();
  EXPECT_EQ(run_program({"plot", "jobs/test", "jobs/test", "-o", file, "--server", server.address()}).exit_code, 0);
  EXPECT_TRUE(fs::exists(file));
}

TEST(Plot, AJobWithoutSamplesAndAnUnknownFormatAreRefused) {
  Script script = finished_script();
  script.samples.clear();
  const FakeServer server(script);
  EXPECT_EQ(run_program({"plot", "test", "-o", server.folder() / "a.png", "--server", server.address()}).exit_code, 2);
  EXPECT_EQ(run_program({"plot", "test", "-o", server.folder() / "a.gif", "--server", server.address()}).exit_code, 2);
}

}  // namespace
}  // namespace cellcrush::client::testing
