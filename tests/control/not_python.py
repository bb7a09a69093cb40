this is no python =
