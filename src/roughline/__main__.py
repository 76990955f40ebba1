"""``python -m roughline``: the command line."""

from roughline.cli import main

if __name__ == "__main__":
    main()
