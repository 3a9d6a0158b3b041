// posectl: the daemon's tool for people and scripts.
#include "client/cli/options.h"
#include "client/cli/output.h"

int main(int argc, char** argv) {
  using namespace posed;
  auto parsed = cli::parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const auto& options = std::get<cli::Options>(parsed);
  if (options.json) cli::say_errors_as_json();
  if (options.run_alone) return options.run_alone();
  auto client = client::Client::connect(options.host, std::chrono::seconds(5), options.identity);
  if (!client) return cli::fail(client.error());
  return options.run({*client, options.json, options.host});
}
