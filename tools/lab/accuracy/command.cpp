// plait-lab accuracy: the table.
#include "command.hpp"
#include "accuracy.hpp"

#include "common/file.hpp"

#include <iostream>

namespace lab {

Exit run(const Command<AccuracyOptions>& command) {
    const AccuracyRun done = run_accuracy(command.on_device());
    if (command.print.json)
        std::cout << json_of(done.results);
    else if (command.print.csv)
        std::cout << csv_of(done.results);
    else
        std::cout << accuracy_text(done) << "wrote " << command.run.out << "/accuracy.csv\n";
    write_text(accuracy_markdown(done), command.run.out + "/accuracy.md");
    return Exit::ok;
}

} // namespace lab
