"""What every computation rests on: transforms, compiled loops, threads and memory."""
