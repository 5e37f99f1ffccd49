// The subcommands. Each adds itself to the command line and leaves its exit code in `exitCode` when it ran.
#pragma once

#include <CLI/CLI.hpp>

namespace scumble::app {

void addRender(CLI::App& program, int& exitCode);
void addFilm(CLI::App& program, int& exitCode);
void addFarm(CLI::App& program, int& exitCode);
void addView(CLI::App& program, int& exitCode);
void addXr(CLI::App& program, int& exitCode);
void addBench(CLI::App& program, int& exitCode);
void addMeasure(CLI::App& program, int& exitCode);
void addPaint(CLI::App& program, int& exitCode);
void addBake(CLI::App& program, int& exitCode);
void addLook(CLI::App& program, int& exitCode);
void addServe(CLI::App& program, int& exitCode);
void addDescriptions(CLI::App& program, int& exitCode);  // info, looks, params, schema, devices

}  // namespace scumble::app
