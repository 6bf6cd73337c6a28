"""The commands of the command line; none of them needs a screen."""
