#include "fuzz/wire_input.h"

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "cellcrush/v1/admin_service.pb.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "rpc/request_fields.h"

namespace cellcrush::fuzz {
namespace {

using google::protobuf::Message;
using google::protobuf::MessageFactory;

constexpr std::size_t kMostCalls = 8;

template <class Value>
const Value& one_of(const std::vector<Value>& values, std::mt19937& random) {
  return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
}

// The seeds of case_fuzzer that are whole.
std::vector<v1::Case> read_cases() {
  std::vector<v1::Case> out;
  for (const auto& entry : std::filesystem::directory_iterator(CELLCRUSH_FUZZ_SEEDS)) {
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    v1::Case read;
    const bool is_whole = entry.path().extension() == ".json"
                              ? google::protobuf::util::JsonStringToMessage(text, &read).ok()
                              : google::protobuf::TextFormat::ParseFromString(text, &read);
    if (is_whole) out.push_back(read);
  }
  return out;
}

v1::Case draw_case(std::mt19937& random) {
  static const std::vector<v1::Case> cases = read_cases();
  return one_of(cases, random);
}

void fill(v1::SweepAxis::Range& range) {
  range.set_first(1.0);
  range.set_last(4.0);
  range.set_count(2);
}

void fill(v1::CreateSweepRequest& request, std::mt19937& random) {
  *request.mutable_sweep()->mutable_case_() = draw_case(random);
  request.set_request_id(one_of<std::string>({"", "of the sweep", "a"}, random));
  const std::string field = one_of<std::string>({"depth_mm", "lattice.hexagon.rows", "lattice.frame.beams[0].elements",
                                                 "lattice.imperfection.seed", "lattice.frame.nodes[1].x_mm"},
                                                random);
  const int kind = std::uniform_int_distribution<int>(0, 4)(random);
  if (kind == 0) {
    (*request.mutable_sweep()->add_points()->mutable_fields())[field] = 3.0;
    return;
  }
  auto& axis = *request.mutable_sweep()->add_axes();
  axis.set_field(field);
  if (kind == 1) axis.mutable_list()->add_values(2.0);
  if (kind == 2) fill(*axis.mutable_linear());
  if (kind == 3) fill(*axis.mutable_logarithmic());
  if (kind == 4) axis.set_seed_count(2);
}

void fill(v1::ListJobsRequest& request, std::mt19937& random) {
  request.set_page_size(one_of<int>({0, 1, 2, 1000}, random));
  request.set_filter(one_of<std::string>({"", "state = FAILED", "label.key = \"value\" AND title : cells"}, random));
  request.set_order_by(one_of<std::string>({"", "name", "create_time desc"}, random));
  const std::string question = request.filter() + "\n" + (request.order_by() == "name" ? "oldest" : "newest");
  if (request.page_size() == 2) request.set_page_token(rpc::page_token(3, question));
}

}  // namespace

std::string Method::path() const { return "/" + descriptor->service()->full_name() + "/" + descriptor->name(); }

std::unique_ptr<Message> Method::new_request() const {
  return std::unique_ptr<Message>(MessageFactory::generated_factory()->GetPrototype(descriptor->input_type())->New());
}

std::unique_ptr<Message> Method::new_response() const {
  return std::unique_ptr<Message>(MessageFactory::generated_factory()->GetPrototype(descriptor->output_type())->New());
}

const std::vector<Method>& methods() {
  static const std::vector<Method> all = [] {
    std::vector<Method> out;
    for (const auto* file : {v1::CheckCaseRequest::descriptor()->file(), v1::CreateJobRequest::descriptor()->file(),
                             v1::CreateSweepRequest::descriptor()->file(), v1::DrainRequest::descriptor()->file()}) {
      for (int i = 0; i < file->service(0)->method_count(); ++i) out.push_back({file->service(0)->method(i)});
    }
    return out;
  }();
  return all;
}

std::vector<WireCall> parse_calls(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHead = 3;
  std::vector<WireCall> out;
  while (size >= kHead && out.size() < kMostCalls) {
    const std::size_t length = std::min<std::size_t>(data[1] * 256U + data[2], size - kHead);
    out.push_back({data[0] % methods().size(), std::string(reinterpret_cast<const char*>(data) + kHead, length)});
    data += kHead + length;
    size -= kHead + length;
  }
  return out;
}

std::string bytes_of(const std::vector<WireCall>& calls) {
  std::string out;
  for (const auto& call : calls) {
    const std::size_t length = std::min<std::size_t>(call.bytes.size(), 65535);
    for (const std::size_t byte : {call.method, length / 256U, length % 256U}) out.push_back(static_cast<char>(byte));
    out.append(call.bytes, 0, length);
  }
  return out;
}

WireCall draw_call(std::mt19937& random) {
  const std::size_t method = std::uniform_int_distribution<std::size_t>(0, methods().size() - 1)(random);
  const auto request = methods()[method].new_request();
  if (const auto* name = request->GetDescriptor()->FindFieldByName("name")) {
    const std::vector<std::string> names = {"jobs/1", "jobs/2", "jobs/3", "jobs/6", "sweeps/1", "aluminium"};
    request->GetReflection()->SetString(request.get(), name, one_of(names, random));
  }
  if (auto* check = dynamic_cast<v1::CheckCaseRequest*>(request.get())) *check->mutable_case_() = draw_case(random);
  if (auto* create = dynamic_cast<v1::CreateJobRequest*>(request.get())) *create->mutable_case_() = draw_case(random);
  if (auto* sweep = dynamic_cast<v1::CreateSweepRequest*>(request.get())) fill(*sweep, random);
  if (auto* list = dynamic_cast<v1::ListJobsRequest*>(request.get())) fill(*list, random);
  return {method, request->SerializeAsString()};
}

}  // namespace cellcrush::fuzz
