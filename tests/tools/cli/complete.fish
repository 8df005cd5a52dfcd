# complete.fish SCRIPT LINE: prints what the completion script offers at the end of the line.
source $argv[1]
complete -C $argv[2]
