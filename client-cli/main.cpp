#include "command_line.h"

int main(int argc, char** argv) { return static_cast<int>(cellcrush::client::run_command_line(argc, argv)); }
