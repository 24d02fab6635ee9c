// The tables of the report: verdicts, errors with orders, the full record of each run.
#pragma once

#include <paper/results.hpp>

#include <map>
#include <string>
#include <vector>

namespace seiche {

// Symbol and word in the colour of the outcome; none of the three is needed to understand the others.
std::string outcome_mark(Outcome outcome);

// By the numbers of figures, "Figure 1, left": the names of their places on the page.
using FigureAnchors = std::map<std::string, std::string>;

std::string verdict_table(const std::vector<Verdict>& verdicts, const FigureAnchors& figures = {});
std::string error_table(const ExampleResult& example);   // method × h, with the orders; notes on what went wrong
std::string record_table(const ExampleResult& example);  // one row per run

}  // namespace seiche
