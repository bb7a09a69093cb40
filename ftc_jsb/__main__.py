"""`python -m ftc_jsb` is `ftc-jsb`."""

from ftc_jsb.cli import main

if __name__ == "__main__":
    main()
